"""The results as Markdown and as JSON."""

import math

from statistics_of_ratios import median, ratio_of

CLOCKS = {"cpu": "cpu_seconds", "wall": "seconds"}


def ratios_of(entries, differences, pairs):
    """A list of objects, one for each scene and pair; without ratios where a side was not measured."""
    by_key = {entry.key: entry for entry in entries}
    rows = []
    for scene in dict.fromkeys(entry.contestant.scene for entry in entries):
        for ours, theirs in pairs:
            a, b = by_key.get((scene, ours)), by_key.get((scene, theirs))
            row = {"scene": scene, "ours": ours, "theirs": theirs,
                   "pictures": _verdict(differences.get((scene, ours, theirs))), "ratios": {}}
            for threads in sorted(set(a.runs) & set(b.runs)) if a and b else ():
                rounds = sorted(set(a.runs[threads]) & set(b.runs[threads]))
                if not rounds:
                    continue
                for clock, member in CLOCKS.items():
                    ratio = ratio_of([a.rate(threads, i, member) for i in rounds],
                                     [b.rate(threads, i, member) for i in rounds])
                    row["ratios"][f"{clock}, threads={threads}"] = {
                        "ratio": ratio.value, "low": finite(ratio.low), "high": finite(ratio.high),
                        "rounds": ratio.rounds}
            rows.append(row)
    return rows


def finite(value):
    return value if math.isfinite(value) else None


def _verdict(difference):
    if difference is None:
        return {"verdict": "not compared"}
    return {"verdict": difference.verdict, "largest_in_standard_errors": difference.largest,
            "limit": difference.limit, "where": difference.where, "relative_difference": difference.relative,
            "relative_standard_error": difference.resolution}


def rates_of(entries):
    """Median thousand samples per second over the rounds, by scene and contestant."""
    rows = []
    for entry in entries:
        rates = {}
        for threads, runs in sorted(entry.runs.items()):
            for clock, member in CLOCKS.items():
                rates[f"{clock}, threads={threads}"] = median([entry.rate(threads, i, member) for i in runs]) / 1000
        rows.append({"scene": entry.contestant.scene, "contestant": entry.contestant.name, "spp": entry.spp,
                     "kilosamples_per_second": rates, "failure": entry.failure})
    return rows


def disturbed(entries):
    """How many runs with one thread had less than 95% of a processor, and how many there were."""
    shares = [run["cpu_seconds"] / run["seconds"] for entry in entries for run in entry.runs.get(1, {}).values()]
    return sum(share < 0.95 for share in shares), len(shares)


def columns_of(threads):
    """CPU time of one thread, and wall-clock time. The CPU time of several threads adds nothing to these."""
    return ([f"cpu, threads={min(threads)}"] + [f"wall, threads={count}" for count in sorted(threads)])


def markdown_ratios(rows, threads):
    columns = columns_of(threads)
    lines = ["| scene | ratio of rates | " + " | ".join(columns) + " | rounds | pictures |",
             "|---|---|" + "---|" * (len(columns) + 2)]
    for row in rows:
        cells = [_cell(row, column) for column in columns]
        rounds = max((ratio["rounds"] for ratio in row["ratios"].values()), default=0)
        lines.append(f"| {row['scene']} | {row['ours']} / {row['theirs']} | {' | '.join(cells)} | {rounds} | "
                     f"{_pictures(row['pictures'])} |")
    return "\n".join(lines)


def _cell(row, column):
    ratio = row["ratios"].get(column)
    if ratio is None:
        return "not measured"
    if row["pictures"]["verdict"] in ("differ", "inconclusive"):
        return "pictures differ" if row["pictures"]["verdict"] == "differ" else "pictures inconclusive"
    return interval(ratio)


def interval(ratio):
    if ratio["low"] is None:
        return f"{ratio['ratio']:.2f} (no interval)"
    return f"{ratio['ratio']:.2f} [{ratio['low']:.2f}, {ratio['high']:.2f}]"


def _pictures(verdict):
    if verdict["verdict"] == "not compared":
        return "not compared"
    return (f"{verdict['verdict']}: {100 * verdict['relative_difference']:+.2f}% "
            f"± {100 * verdict['relative_standard_error']:.2f}%, at most {verdict['largest_in_standard_errors']:.1f} "
            f"of {verdict['limit']:.1f} se")


def markdown_rates(rows, threads):
    columns = columns_of(threads)
    lines = ["| scene | renderer | " + " | ".join(columns) + " |", "|---|---|" + "---|" * len(columns)]
    for row in rows:
        rates = row["kilosamples_per_second"]
        cells = [f"{rates[column]:.0f}" if column in rates else "not measured" for column in columns]
        lines.append(f"| {row['scene']} | {row['contestant']} | {' | '.join(cells)} |")
    return "\n".join(lines)
