"""What a task costs besides its render, and two workers against one."""

import json
import statistics
import subprocess
import time

from machine import described
from site_of_processes import ROOT, Site

SCENE = ROOT / "scenes/cornell_glass.dae"
TINY = ["--size", "1x1", "-t", "1"]
LARGE = ["--size", "64x64", "-t", "1"]
TINY_TASKS = 400
LARGE_BATCHES = 32  # of a task
MERGED = (480, 270)  # pixels


def measure(program, folder, out):
    measured = {"machine": described(), "command": "./run farmfaults --overhead"}
    measured["program_seconds"] = _program(program, folder)
    for workers in (1, 2):
        measured[f"tiny_tasks_{workers}"] = _farm(folder, workers, TINY_TASKS, 1, TINY, f"tiny{workers}")
    for workers in (1, 2):
        measured[f"large_tasks_{workers}"] = _farm(folder, workers, 16 * LARGE_BATCHES, LARGE_BATCHES, LARGE, f"large{workers}")
    one, two = measured["tiny_tasks_1"], measured["tiny_tasks_2"]
    # At one worker a task costs the program's own start, the worker's and the driver's; at two what is serial shows.
    measured["overhead_seconds_per_task"] = one["seconds"] / one["tasks"] - measured["program_seconds"]
    measured["serial_seconds_per_task"] = one["driver_and_scheduler_cpu_seconds"] / one["tasks"]
    large = measured["large_tasks_1"]
    measured["seconds_per_sample"] = large["seconds"] / (large["tasks"] * LARGE_BATCHES * 4 * 64 * 64)
    measured |= _merge(program, folder)
    measured["tiny_speedup_2"] = one["seconds"] / two["seconds"]
    measured["speedup_2"] = measured["large_tasks_1"]["seconds"] / measured["large_tasks_2"]["seconds"]
    out.write_text(json.dumps(measured, indent=1) + "\n")
    print(json.dumps(measured, indent=1))
    return 0


def _program(program, folder):
    """Seconds of a tiny render and of --version, which a task also runs: the median of 20."""
    taken = []
    for _ in range(20):
        begin = time.monotonic()
        subprocess.run([program, "--version"], stdout=subprocess.DEVNULL, check=True)
        command = [program, "render", SCENE, "--batches", "0..1", "--batch", "4", "-q", "-o", folder / "tiny.exr", *TINY]
        subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)
        taken.append(time.monotonic() - begin)
    return statistics.median(taken)


def _merge(program, folder):
    """What the merge costs for each part: 16 parts against 2."""
    width, height = MERGED
    parts, taken = [], {}
    for number in range(16):
        parts.append(folder / f"merge{number}.exr")
        command = [program, "render", SCENE, "--batches", f"{number}..{number + 1}", "--batch", "1", "-q", "-o", parts[-1],
                   "--size", f"{width}x{height}", "--max-edges", "3"]  # fmt: skip
        subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)
    for count in (2, 16):
        begin = time.monotonic()
        command = [program, "merge", *parts[:count], "-q", "-o", folder / "merged.exr"]
        subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)
        taken[count] = time.monotonic() - begin
    pixels = width * height
    return {
        "merge_seconds_per_part_and_megapixel": (taken[16] - taken[2]) / 14 / (pixels / 1e6),
        "part_bytes_per_pixel": parts[3].stat().st_size / pixels,
    }


def _cpu_seconds(process):
    user, system = (int(text) for text in open(f"/proc/{process.pid}/stat").read().rpartition(")")[2].split()[11:13])
    return (user + system) / 100


def _farm(folder, workers, batches, task_batches, options, name):
    """Seconds between the first part and the last, so that the start of driver and workers is not counted."""
    with Site(folder / name) as site:
        site.start_scheduler()
        for _ in range(workers):
            site.start_worker()
        parts = folder / name / "parts"
        arguments = [SCENE, "-s", batches * 4, "--batch", 4, "-o", folder / name / "whole.exr", "--parts", parts,
                     "--scheduler", site.url, "--task-batches", task_batches, "-q", "--", *options]  # fmt: skip
        time.sleep(8)  # until the workers are there
        driver = site.driver(arguments)
        cpu = 0.0
        while driver.poll() is None:
            try:
                cpu = _cpu_seconds(driver) + _cpu_seconds(site.scheduler)
            except (OSError, IndexError, ValueError):
                pass
            time.sleep(0.2)
        if driver.returncode:
            raise SystemExit(f"farmfaults: {site.said()}")
        written = sorted(path.stat().st_mtime for path in parts.glob("batches_*.exr"))
        return {
            "tasks": len(written) - workers,  # those that ended after the first of each worker
            "seconds": written[-1] - written[workers - 1],
            "driver_and_scheduler_cpu_seconds": cpu,
        }
