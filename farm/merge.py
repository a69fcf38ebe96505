"""Joins many parts: groups of neighbours at the same time, one on each processor, then what these have made. A merge of merges has the
bits of one merge (docs/farm.md)."""

import concurrent.futures
import math
import os

GROUP = 16  # parts, at least


def processors():
    return len(os.sched_getaffinity(0))


def merge(job, folder, names, outputs, samples, finish=False):
    """`names`: the parts, in the order of their batches. Raises JobError."""
    size = max(GROUP, math.ceil(len(names) / processors()))
    if len(names) <= 2 * GROUP or size >= len(names):
        return job.merge(folder, names, outputs, samples, finish)
    groups = [names[at : at + size] for at in range(0, len(names), size)]
    merged = [f".driver-{number}.tmp-group.exr" for number in range(len(groups))]
    try:
        with concurrent.futures.ThreadPoolExecutor(processors()) as pool:
            list(pool.map(lambda group, name: job.merge(folder, group, [folder / name]), groups, merged))
        job.merge(folder, merged, outputs, samples, finish)
    finally:
        for name in merged:
            (folder / name).unlink(missing_ok=True)
