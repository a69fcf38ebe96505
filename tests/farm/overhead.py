"""What a task costs besides its render, and two workers against one."""

import json
import os
import resource
import statistics
import subprocess
import time

from site_of_processes import ROOT, Site, machine

SCENE = ROOT / "scenes/cornell_glass.dae"
TINY = ["--size", "1x1", "-t", "1"]
LARGE = ["--size", "64x64", "-t", "1"]
TINY_TASKS = 400
LARGE_BATCHES = 32  # of a task
MERGED = (480, 270)  # pixels


def measure(program, folder, out):
    measured = {"machine": machine(), "command": "./run farmfaults --overhead", "load_before": os.getloadavg()[0]}
    measured |= _program(program, folder)
    measured |= _merge(program, folder)
    for workers in (1, 2):
        measured[f"tiny_tasks_{workers}"] = _farm(folder, workers, TINY_TASKS, 1, TINY, f"tiny{workers}")
    for workers in (1, 2):
        measured[f"large_tasks_{workers}"] = _farm(folder, workers, 12 * LARGE_BATCHES, LARGE_BATCHES, LARGE, f"large{workers}")
    one, two = measured["tiny_tasks_1"], measured["tiny_tasks_2"]
    large = [measured[f"large_tasks_{workers}"] for workers in (1, 2)]
    measured["overhead_seconds_per_task"] = one["seconds"] / one["tasks"]
    measured["serial_seconds_per_task"] = one["driver_and_scheduler_cpu_seconds"] / TINY_TASKS
    measured["tiny_speedup_2"] = one["seconds"] / one["tasks"] / (two["seconds"] / two["tasks"])
    measured["speedup_2"] = large[0]["seconds"] / large[0]["tasks"] / (large[1]["seconds"] / large[1]["tasks"])
    out.write_text(json.dumps(measured, indent=1) + "\n")
    print(json.dumps(measured, indent=1))
    return 0


def _run(*command):
    """Processor seconds of the program: other programs on the machine do not count."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _program(program, folder):
    """Seconds of a tiny render and of --version, which a task also runs (medians of 20), and what a sample costs."""
    taken, render = [], [program, "render", SCENE, "--batch", "4", "-q", "-o", folder / "tiny.exr", "--batches"]
    for _ in range(20):
        begin = time.monotonic()
        _run(program, "--version")
        _run(*render, "0..1", *TINY)
        taken.append(time.monotonic() - begin)
    large = statistics.median(_run(*render, f"0..{LARGE_BATCHES}", *LARGE) for _ in range(3))
    return {"program_seconds": statistics.median(taken), "seconds_per_sample": large / (LARGE_BATCHES * 4 * 64 * 64)}


def _merge(program, folder):
    """What the merge costs for each part: 16 parts against 2."""
    width, height = MERGED
    parts = [folder / f"merge{number}.exr" for number in range(16)]
    for number, part in enumerate(parts):
        _run(program, "render", SCENE, "--batches", f"{number}..{number + 1}", "--batch", "1", "-q", "-o", part,
             "--size", f"{width}x{height}", "--max-edges", "3")  # fmt: skip
    few, many = (_run(program, "merge", *parts[:count], "-q", "-o", folder / "merged.exr") for count in (2, 16))
    pixels = width * height
    return {
        "merge_seconds_per_part_and_megapixel": (many - few) / 14 / (pixels / 1e6),
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
