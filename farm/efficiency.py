"""How well N workers are used, on paper: from the measured costs of a task (docs/farm.md has the formula in words).

    efficiency.py [out/farm/overhead.json] [--pixels 1920x1080] [--samples 16384] [--batch 4] [--seconds-per-sample S]

A job has B batches of b seconds of one worker. A task of M batches takes T = M b, and costs o more at its worker (the start of the
program, and the worker's Python) and s at the driver and the scheduler, which serve one task after the other. n = B / M tasks at N
workers take

    max(n (T + o) / N + (T' + o) / 2,  T + o,  n s)  +  n m

The last tasks are smaller (speed.py): of T' = max(T / 8, b). At the end a worker waits for half of one on average. m is what the
merge needs for a part, on one processor, after the last task. The efficiency is B b / N divided by this time.
"""

import argparse
import json
import math
import pathlib
from typing import NamedTuple

WORKERS = (10, 100, 1_000, 10_000)
SIZES = (1, 4, 16, 64, 256)


class Costs(NamedTuple):
    """Seconds: of a batch, and for each task at its worker, in what is serial, and in the merge."""

    batch: float
    overhead: float
    serial: float
    merge: float


def seconds(batches, workers, size, costs):
    """Of the whole job, with tasks of `size` batches."""
    tasks = math.ceil(batches / size)
    task = size * costs.batch
    last = max(task / 8, costs.batch) if size > 1 else task
    shared = tasks * (task + costs.overhead) / workers + (last + costs.overhead) / 2
    rendered = max(shared, task + costs.overhead, tasks * costs.serial)
    return rendered + tasks * costs.merge


def efficiency(batches, workers, size, costs):
    return batches * costs.batch / (workers * seconds(batches, workers, size, costs))


def best_size(batches, workers, costs):
    """The power of two with which the job is done first."""
    return min((1 << power for power in range(batches.bit_length())), key=lambda size: seconds(batches, workers, size, costs))


def table(batches, costs):
    """Markdown."""
    lines = ["| workers | " + " | ".join(f"M = {size}" for size in SIZES) + " | best M | T | efficiency | whole job |"]
    lines.append("|---:|" + "---:|" * (len(SIZES) + 4))
    for workers in WORKERS:
        cells = [f"{100 * efficiency(batches, workers, size, costs):.1f}%" for size in SIZES]
        size = best_size(batches, workers, costs)
        cells += [str(size), f"{size * costs.batch:.0f} s", f"{100 * efficiency(batches, workers, size, costs):.1f}%"]
        lines.append(f"| {workers:,} | " + " | ".join(cells) + f" | {seconds(batches, workers, size, costs) / 60:.1f} min |")
    return "\n".join(lines)


def main():
    made = argparse.ArgumentParser(description="Efficiency of ./run farm, on paper.")
    made.add_argument("measured", nargs="?", type=pathlib.Path, default=pathlib.Path("out/farm/overhead.json"))
    made.add_argument("--pixels", default="1920x1080")
    made.add_argument("--samples", type=int, default=16384)
    made.add_argument("--batch", type=int, default=4)
    made.add_argument("--seconds-per-sample", type=float, help="of one worker (as measured)")
    arguments = made.parse_args()
    measured = json.loads(arguments.measured.read_text())
    pixels = math.prod(int(text) for text in arguments.pixels.split("x"))
    sample = arguments.seconds_per_sample or measured["seconds_per_sample"]
    costs = Costs(
        batch=pixels * arguments.batch * sample,
        overhead=measured["overhead_seconds_per_task"],
        serial=measured["serial_seconds_per_task"],
        merge=measured["merge_seconds_per_part_and_megapixel"] * pixels / 1e6,
    )
    batches = arguments.samples // arguments.batch
    work = batches * costs.batch
    print(f"{pixels * arguments.samples:.2g} samples of {1e6 * sample:.1f} us: {work / 3600:.1f} hours of one worker.")
    print(f"{batches} batches of b = {costs.batch:.1f} s.")
    print(f"o = {costs.overhead:.3f} s, s = {1e3 * costs.serial:.1f} ms, m = {costs.merge:.2f} s.")
    print(f"A part has {measured['part_bytes_per_pixel'] * pixels / 1e6:.0f} MB.\n")
    print(table(batches, costs))
    print("\nWithout the merge:\n")
    print(table(batches, costs._replace(merge=0.0)))


if __name__ == "__main__":
    main()
