"""The machine and the day of a measurement, in words."""

import datetime
import os
import pathlib
import platform


def described():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    model = next((line.partition(": ")[2] for line in lines if line.startswith("model name")), platform.machine())
    return f"{model}, {len(os.sched_getaffinity(0))} cores, {datetime.date.today().isoformat()}"
