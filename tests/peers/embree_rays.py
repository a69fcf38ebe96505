"""Plumbline's trees beside Embree: diffuse rays of tests/bench/fast_bench.cpp, repetition by repetition."""

import json
import os
import re
import subprocess

from problem import Problem
from report import finite, interval
from statistics_of_ratios import ratio_of

OURS = "hploc-wide"
THEIRS = ("embree-low", "embree-medium")
SCENES = ("sphere-1e5", "sphere-1e6")


def measure(program, repetitions, folder):
    """A list of objects, one for each scene and quality of Embree's tree. Raises Problem."""
    output = os.path.join(folder, "embree.json")
    names = "|".join((OURS, *THEIRS))
    command = [program, f"--benchmark_filter=^diffuse/({'|'.join(SCENES)})/({names})$",
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


def rows_of(report):
    """From Google Benchmark's JSON. Rates are inverse times, so the ratio of rates is theirs over ours in time."""
    times = {}
    for each in report["benchmarks"]:
        match = re.fullmatch(r"diffuse/([^/]+)/([^/]+)", each.get("run_name", each["name"]))
        if match and each.get("run_type", "iteration") == "iteration":
            times.setdefault(match.groups(), {})[each.get("repetition_index", 0)] = each["cpu_time"]
    rows = []
    for scene in SCENES:
        ours = times.get((scene, OURS), {})
        for name in THEIRS:
            theirs = times.get((scene, name), {})
            common = sorted(set(ours) & set(theirs))
            if common:
                ratio = ratio_of([1 / ours[i] for i in common], [1 / theirs[i] for i in common])
                rows.append({"scene": scene, "ours": OURS, "theirs": name, "ratio": ratio.value,
                             "low": finite(ratio.low), "high": finite(ratio.high), "rounds": ratio.rounds})
    if not rows:
        raise Problem("bench_fast measured nothing beside Embree: was it built without libembree-dev?")
    return rows


def markdown(rows):
    lines = ["| scene | ratio of rates, diffuse rays | CPU, 1 thread | repetitions |", "|---|---|---|---|"]
    for row in rows:
        lines.append(f"| {row['scene']} | {row['ours']} / {row['theirs']} | {interval(row)} | {row['rounds']} |")
    return "\n".join(lines)
