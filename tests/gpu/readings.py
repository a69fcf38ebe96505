"""Reads what the programs of the steps print: status, reason and numbers."""
import csv
import json
import math
import re
from typing import NamedTuple

PASSED, FAILED, SKIPPED, TIMED_OUT = "passed", "failed", "skipped", "timed out"


class Reading(NamedTuple):
    status: str
    reason: str
    numbers: dict


def plain(code, out, err):
    """For a command whose exit status says everything."""
    if code == 0:
        return Reading(PASSED, "", {})
    lines = [line for line in (err + "\n" + out).splitlines() if line.strip()]
    return Reading(FAILED, f"exit status {code}" + (f": {lines[-1].strip()}" if lines else ""), {})


def driver(code, out, err):
    numbers = {"gpus": [line.strip() for line in out.splitlines() if line.strip()]}
    return plain(code, "", out + err)._replace(numbers=numbers)


def device(code, out, err):
    """`plumbline --version` exits with 0 whether there is a device or not: the line after "GPU: " tells."""
    failed = plain(code, out, err)
    if code != 0:
        return failed
    found = re.search(r"^GPU: (.*)$", out, re.M)
    described = found[1] if found else "no line that describes the GPU"
    usable = re.search(r", sm_\d+, driver for CUDA ", described) and "cannot be used:" not in described
    return Reading(PASSED if usable else FAILED, "" if usable else described, {"described": described})


def tools(code, out, err):
    numbers = {name: path for name, _, path in (line.partition(" ") for line in out.splitlines())}
    return plain(code, "", err)._replace(numbers=numbers)


def gtest(code, out, err):
    """Skipped tests are named and not counted as passed; a run of no test at all has failed."""
    ended = re.findall(r"^\[ +(OK|FAILED|SKIPPED) +\] ([^\s,]+).*\((\d+) ms\)$", out, re.M)
    names = {result: [name for what, name, _ in ended if what == result] for result in ("OK", "FAILED", "SKIPPED")}
    numbers = {"passed": len(names["OK"]), "failed": names["FAILED"], "skipped": names["SKIPPED"],
               "milliseconds": {name: int(ms) for _, name, ms in ended}}
    started = re.findall(r"^\[ RUN +\] (\S+)$", out, re.M)
    stopped = [name for name in started if name not in numbers["milliseconds"]]
    if stopped:
        numbers["did_not_end"] = stopped
    if names["FAILED"]:
        more = f" and {len(names['FAILED']) - 1} more" if len(names["FAILED"]) > 1 else ""
        return Reading(FAILED, f"{names['FAILED'][0]}{more} failed", numbers)
    if code != 0:
        where = f" in {stopped[-1]}" if stopped else ""
        return Reading(FAILED, f"exit status {code}{where}", numbers)
    if not ended:
        return Reading(FAILED, "no test ran", numbers)
    if not names["OK"]:
        return Reading(SKIPPED, f"all {len(ended)} tests were skipped", numbers)
    skipped = f"{len(names['SKIPPED'])} tests were skipped, wholly or in part" if names["SKIPPED"] else ""
    return Reading(PASSED, skipped, numbers)


def sanitizer(code, out, err):
    """compute-sanitizer: passed only if its summary is there and counts nothing."""
    text = out + err
    found = re.findall(r"ERROR SUMMARY: (\d+) error|RACECHECK SUMMARY: (\d+) hazard", text)
    if not found:
        lines = [line for line in text.splitlines() if line.startswith("=========")]
        return Reading(FAILED, f"no summary: {lines[-1].strip('= ') if lines else f'exit status {code}'}", {})
    count = sum(int(errors or hazards) for errors, hazards in found)
    numbers = {"errors": count}
    if count > 0:
        return Reading(FAILED, f"{count} errors or hazards", numbers)
    return plain(code, out, err)._replace(numbers=numbers)


def sanitized_gtest(code, out, err):
    """Both: no error was found, and there were tests to find it in."""
    check, tests = sanitizer(code, out, err), gtest(code, out, err)
    worst = check if check.status != PASSED else tests
    return Reading(worst.status, worst.reason, {**check.numbers, "tests_passed": tests.numbers["passed"]})


def object_of(out):
    """The JSON object that a command printed, or None."""
    try:
        found = json.loads(out)
    except ValueError:
        return None
    return found if isinstance(found, dict) else None


def render(code, out, err):
    found = object_of(out)
    if code != 0 or found is None:
        return plain(code, out, err) if code != 0 else Reading(FAILED, "printed no JSON object", {})
    numbers = {key: found.get(key) for key in ("seconds", "samples_per_second", "cpu_seconds", "mean_rgb",
                                               "mean_rgb_standard_error", "dropped", "kernel")}
    wrong = [why for why, is_wrong in (("not rendered on the device", found.get("device") != "cuda"),
                                       ("not complete", found.get("complete") is not True),
                                       ("black", found.get("black_despite_emitters") is True)) if is_wrong]
    return Reading(FAILED if wrong else PASSED, ", ".join(wrong), numbers)


def trees(code, out, err):
    """plumbline bvh --json: milliseconds per stage. It fails by itself if a figure is not plausible."""
    found = object_of(out)
    if found is None:
        return plain(code, out, err) if code != 0 else Reading(FAILED, "printed no JSON object", {})
    numbers = {"primitives": found.get("primitives"), "bytes_per_second": found.get("bytes_per_second")}
    for build in found.get("builders", []):
        numbers[f"{build['name']} ms"] = build["ms"]
        numbers[f"{build['name']} bytes_per_primitive"] = build["bytes_per_primitive"]
        for stage in build["stages"]:
            for key in ("ms", "percent_of_bandwidth"):
                if key in stage:
                    numbers[f"{build['name']} {stage['name']} {key}"] = stage[key]
    if found.get("plausible") is not True:
        return Reading(FAILED, "a stage claims to move more than the memory can", numbers)
    if found.get("device") != "cuda":
        return Reading(FAILED, "not built on the device", numbers)
    return plain(code, "", err)._replace(numbers=numbers)


NCU_METRICS = ("Duration", "Registers Per Thread", "Block Size", "Grid Size", "Theoretical Occupancy",
               "Achieved Occupancy", "Compute (SM) Throughput", "Memory Throughput", "DRAM Throughput")


def ncu(code, out, err):
    """Nsight Compute's table, a row per kernel and metric. Other lines stand before it."""
    lines = out.splitlines()
    begin = next((i for i, line in enumerate(lines) if line.startswith('"ID"')), None)
    launches = {}
    for row in csv.DictReader(lines[begin:]) if begin is not None else []:
        name, unit, value = row.get("Metric Name"), row.get("Metric Unit") or "", row.get("Metric Value")
        if name not in NCU_METRICS or not value:
            continue
        launch = launches.setdefault(row["ID"], {"kernel": row["Kernel Name"]})
        try:
            launch[f"{name} ({unit})" if unit else name] = float(value.replace(",", ""))
        except ValueError:
            launch[name] = value
    numbers = {"launches": list(launches.values())}
    if code != 0 or not launches:
        why = [line for line in (out + "\n" + err).splitlines() if re.match(r"==(ERROR|WARNING)==", line)]
        return Reading(FAILED, why[-1] if why else f"no kernel was measured, exit status {code}", numbers)
    missing = [name for name in ("Registers Per Thread", "Achieved Occupancy", "Compute (SM) Throughput")
               if not any(key.startswith(name) for key in next(iter(launches.values())))]
    return Reading(FAILED if missing else PASSED, f"ncu printed no {missing[0]}" if missing else "", numbers)


# Quantiles of Student's distribution for intervals of 95%, by degrees of freedom.
STUDENT = (math.nan, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262)


def over_rounds(rounds):
    """The numbers of several rounds as one: for each float, all values, the mean and its 95% interval."""
    result = {}
    for key in rounds[0]:
        values = [numbers[key] for numbers in rounds if key in numbers]
        if not all(isinstance(value, float) for value in values):
            result[key] = values[-1]
            continue
        mean = sum(values) / len(values)
        result[key] = {"rounds": values, "mean": mean}
        if 2 <= len(values) <= len(STUDENT):
            variance = sum((value - mean) ** 2 for value in values) / (len(values) - 1)
            result[key]["half_width_95"] = STUDENT[len(values) - 1] * math.sqrt(variance / len(values))
    return result
