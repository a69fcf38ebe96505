"""The results as tables: JSON for machines, Markdown for readers."""

import collections
import dataclasses
import json
import pathlib
import types

import judged
from keep import Outcome

TEN = 10
NO_REASONS = types.MappingProxyType({})


def score(results):
    """killed and all by folder of the changed file; mutants that are equivalent are not counted, in either number."""
    count = collections.defaultdict(lambda: [0, 0])
    for result in results:
        if not result.equivalent:
            area = count[str(pathlib.PurePosixPath(result.file).parent)]
            area[0] += result.outcome.killed
            area[1] += 1
    return dict(sorted((area, tuple(numbers)) for area, numbers in count.items()))


def seconds_of(test, times):
    """The measured time of a test; None for what is no test of gtest (an end outside of tests, another program)."""
    return next((tests[test] for tests in times.values() if test in tests), None)


def cheapest(results, times):
    """(kills per second, kills, seconds, test), most first, of the first test that noticed each. A test whose time is below a millisecond counts as one."""
    kills = collections.Counter(r.killed_by for r in results if r.killed_by)
    known = {name: seconds_of(name, times) for name in kills}
    found = [(kills[n] / max(t, 0.001), kills[n], t, n) for n, t in known.items() if t is not None]
    return sorted(found, key=lambda row: (-row[0], row[3]))[:TEN]


def by_one_test(results):
    """(mutant, test) of the mutants that exactly one test noticed. Only where tests were weighed."""
    return [(r.name, r.killers[0]) for r in results if r.weighed and len(r.killers) == 1]


def idle(mutants, results, times):
    """Tests that noticed no mutant, of all programs of these mutants. Only where tests were weighed."""
    used = {f"release/{program}" for mutant in mutants for program in mutant.programs}
    killing = {name for result in results for name in result.killers}
    return sorted(name for key in used for name in times.get(key, {}) if name not in killing)


def as_json(mutants, results, times, run, reasons=NO_REASONS):
    """`reasons`: of tests that notice nothing (judged.py)."""
    complete = bool(results) and all(result.weighed for result in results)
    counted = {outcome.value: sum(result.outcome is outcome for result in results) for outcome in Outcome}
    table = {
        "run": run,
        "outcomes": counted,
        "equivalent": sum(bool(result.equivalent) for result in results),
        "areas": {area: {"killed": killed, "mutants": all_} for area, (killed, all_) in score(results).items()},
        "cheapest": [dict(zip(("kills_per_second", "kills", "seconds", "test"), row)) for row in cheapest(results, times)],
        "mutants": [dict(dataclasses.asdict(result), outcome=result.outcome.value) for result in results],
    }
    if complete:
        table["by_one_test"] = dict(by_one_test(results))
        table["tests_that_kill_nothing"] = {test: judged.reason_of(test, reasons) for test in idle(mutants, results, times)}
    return json.dumps(table, indent=1) + "\n"


def as_markdown(mutants, results, times, run, reasons=NO_REASONS):
    lines = ["# Mutants", "", *(f"{key.replace('_', ' ')}: {value}  " for key, value in run.items()), ""]
    lines += _table(
        ("area", "killed", "mutants", "score"),
        [(area, k, n, f"{100 * k / n:.0f}%") for area, (k, n) in _with_total(score(results)).items()],
    )
    if left := [result for result in results if not result.fine]:
        lines += ["## What must be looked at", ""]
        lines += [f"- `{r.name}`: {'; '.join([r.outcome.value, *r.wrong, *r.detail.splitlines()[:1]])}" for r in left] + [""]
    lines += ["## The ten tests with most kills per second", ""]
    rows = [(f"`{test}`", kills, f"{s:.3f}", f"{rate:.0f}") for rate, kills, s, test in cheapest(results, times)]
    lines += _table(("test", "kills", "seconds", "kills per second"), rows)
    lines += _of_weighed_tests(mutants, results, times, reasons)
    lines += ["## All mutants", ""]
    order = sorted(results, key=lambda r: (r.fine, r.file, r.name))
    rows = [
        (f"`{r.name}`", f"`{r.file}`", _said(r), f"`{r.killed_by}`" if r.killed_by else "", _s(r.build_seconds), _s(r.test_seconds))
        for r in order
    ]
    lines += _table(("mutant", "file", "outcome", "killed by", "build, s", "tests, s"), rows)
    return "\n".join(lines).rstrip("\n") + "\n"


def _of_weighed_tests(mutants, results, times, reasons):
    if not results or not all(result.weighed for result in results):
        return [
            "Each mutant was tried until the first test failed. `./run mutants --weigh-tests` tells which mutants only one test notices,",
            "and which tests notice none.",
            "",
        ]
    killed, alone = sum(result.outcome.killed for result in results), by_one_test(results)
    share = f"{len(alone)} of {killed} ({100 * len(alone) / killed:.0f}%)" if killed else "none"
    lines = ["## Mutants that only one test notices", "", share, ""]
    lines += _table(("mutant", "test"), [(f"`{name}`", f"`{test}`") for name, test in alone])
    unused = idle(mutants, results, times)
    lines += ["## Tests that notice none of these mutants", "", f"{len(unused)} of {_tests(mutants, times)}", ""]
    found = {test: judged.reason_of(test, reasons) for test in unused}
    lines += ["A test was run with the mutants whose heads name a test of the same file; if there are none, with no mutant.", ""]
    rows = [(", ".join(_suites(found, reason)), list(found.values()).count(reason), reason) for reason in dict.fromkeys(found.values()) if reason]
    lines += _table(("tests", "number", "reason to exist"), sorted(rows))
    if left := [f"- `{test}`" for test, reason in found.items() if not reason]:
        lines += [f"Without a reason in `tests/mutants/idle.toml`: {len(left)}", "", *left, ""]
    return lines


def _suites(found, reason):
    """The suites of the tests with this reason, without the prefix of an instance ("All/Suite") or the number of a type ("Suite/0")."""
    parts = [test.partition(".")[0].split("/") for test, other in found.items() if other == reason]
    return sorted({f"`{[part for part in suite if not part.isdigit()][-1]}`" for suite in parts})


def _tests(mutants, times):
    return sum(len(times.get(key, {})) for key in {f"release/{p}" for mutant in mutants for p in mutant.programs})


def _with_total(areas):
    total = tuple(sum(numbers[i] for numbers in areas.values()) for i in (0, 1))
    return {**areas, "all": total} if total[1] else {}


def _said(result):
    return result.outcome.value + (f" (equivalent: {result.equivalent})" if result.equivalent else "")


def _s(seconds):
    return f"{seconds:.1f}"


def _table(head, rows):
    if not rows:
        return []
    lines = ["| " + " | ".join(str(cell).replace("|", "\\|").replace("\n", " ") for cell in row) + " |" for row in rows]
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *lines, ""]
