"""Plumbline's trees beside Embree: builds and diffuse rays of tests/bench/fast_bench.cpp, repetition by repetition."""

import json
import os
import re
import subprocess
from collections import namedtuple

from problem import Problem
from report import finite, interval
from statistics_of_ratios import ratio_of

SCENES = ("sphere-1e5", "sphere-1e6")

# Two benchmarks, "{}" being the scene; the time that counts: of the processor, or on the clock.
Compared = namedtuple("Compared", "what ours theirs time")
COMPARED = (
    *(Compared("diffuse rays", "diffuse/{}/hploc-wide", f"diffuse/{{}}/embree-{quality}", "cpu_time")
      for quality in ("low", "medium", "low-robust", "medium-robust")),
    *(Compared("build, 1 thread", f"build/{{}}/{ours}/1", "build/{}/embree-low/1", "cpu_time")
      for ours in ("morton63", "hploc", "hploc-wide")),
    *(Compared("build, 2 threads / 1 thread", f"build/{{}}/{who}/2/real_time", f"build/{{}}/{who}/1", "real_time")
      for who in ("hploc", "hploc-wide", "embree-low")),
)


def measure(program, repetitions, folder):
    """A list of objects, one for each scene and pair that is compared. Raises Problem."""
    output = os.path.join(folder, "embree.json")
    names = sorted({name.format(scene) for each in COMPARED for name in (each.ours, each.theirs) for scene in SCENES})
    command = [program, f"--benchmark_filter=^({'|'.join(names)})$",
               f"--benchmark_repetitions={repetitions}", "--benchmark_enable_random_interleaving=true",
               "--benchmark_out_format=json", f"--benchmark_out={output}"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, start_new_session=True)
    except OSError as error:
        raise Problem(f"{program}: {error.strerror}") from None
    if done.returncode != 0:
        raise Problem(f"{program}: {(done.stderr.strip() or 'failed').splitlines()[-1]}")
    with open(output, encoding="utf-8") as file:
        return rows_of(json.load(file))


def short(name):
    """"build/{}/hploc/2/real_time" -> "hploc"."""
    return re.match(r"\w+/\{\}/([^/]+)", name)[1]


def rows_of(report):
    """From Google Benchmark's JSON. Rates are inverse times, so the ratio of rates is theirs over ours in time."""
    runs = {}
    for each in report["benchmarks"]:
        if each.get("run_type", "iteration") == "iteration":
            runs.setdefault(each.get("run_name", each["name"]), {})[each.get("repetition_index", 0)] = each
    rows = []
    for what, ours, theirs, time in COMPARED:
        for scene in SCENES:
            one, other = runs.get(ours.format(scene), {}), runs.get(theirs.format(scene), {})
            common = sorted(set(one) & set(other))
            if common:
                ratio = ratio_of([1 / one[i][time] for i in common], [1 / other[i][time] for i in common])
                rows.append({"what": what, "scene": scene, "ours": short(ours), "theirs": short(theirs),
                             "ratio": ratio.value, "low": finite(ratio.low), "high": finite(ratio.high),
                             "rounds": ratio.rounds})
    if not any(row["theirs"].startswith("embree") for row in rows):
        raise Problem("bench_fast measured nothing beside Embree: was it built without libembree-dev?")
    return rows


def markdown(rows):
    lines = ["| what | scene | ratio of rates | value, 95% interval | repetitions |", "|---|---|---|---|---|"]
    for row in rows:
        pair = row["ours"] if row["ours"] == row["theirs"] else f"{row['ours']} / {row['theirs']}"
        lines.append(f"| {row['what']} | {row['scene']} | {pair} | {interval(row)} | {row['rounds']} |")
    return "\n".join(lines)
