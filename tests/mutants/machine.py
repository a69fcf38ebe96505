"""The machine of a measurement, in words."""

import os
import pathlib
import platform


def processors():
    """How many this program may use."""
    return len(os.sched_getaffinity(0))


def processor():
    """Model and number of cores."""
    try:
        lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    model = next((text.partition(": ")[2] for text in lines if text.startswith("model name")), platform.machine())
    return f"{model}, {processors()} cores"
