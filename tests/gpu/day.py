#!/usr/bin/env python3
"""Called by day.sh. Runs the steps of steps.py one after the other and keeps the record in one JSON file."""
import argparse
import os
import re
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path

import readings
from record import Record
from running import run, run_step
from steps import all_steps

ROOT = Path(__file__).resolve().parents[2]
NO_GPU = 77


class Bad(Exception):
    """Bad input: one line for a person."""


class OneLineParser(argparse.ArgumentParser):
    def error(self, message):
        raise Bad(message)


def options():
    parser = OneLineParser(prog="day.sh", description="Tests and measures a build on a machine with a GPU, in under "
                           "10 minutes, from a build made elsewhere (carry.sh).",
                           epilog="Exit status: 0 every step passed, 1 a step failed or timed out, 2 bad input, "
                           "77 no GPU, or steps were skipped, 130 interrupted.")
    parser.add_argument("--build", type=Path, metavar="FOLDER", default=ROOT / "build/cuda",
                        help="the build [build/cuda]")
    parser.add_argument("--steps", metavar="LIST", help="only these steps: names or their beginnings, as in tests,bench.trees")
    parser.add_argument("--limit", type=float, metavar="SECONDS", help="no step may take longer")
    parser.add_argument("--dry-run", action="store_true", help="list the steps with their commands, and run none")
    parser.add_argument("-o", dest="record", type=Path, metavar="FILE",
                        help="the record [out/gpu_day.json; with --dry-run, none]")
    chosen = parser.parse_args()
    if chosen.limit is not None and not chosen.limit > 0:
        raise Bad("--limit: expected a number of seconds above 0")
    chosen.build = chosen.build.resolve()
    if chosen.build.is_relative_to(ROOT):
        chosen.build = chosen.build.relative_to(ROOT)
    if chosen.record is None and not chosen.dry_run:
        chosen.record = ROOT / "out/gpu_day.json"
    if chosen.record is not None and chosen.record.is_dir():
        raise Bad(f"-o: {chosen.record} is a folder")
    return chosen


def chosen_steps(steps, wanted):
    if wanted is None:
        return steps
    names = [name for name in wanted.split(",") if name]
    for name in names:
        if not any(is_or_begins(step.name, name) for step in steps):
            raise Bad(f"--steps: no step is called {name} (there are {', '.join(step.name for step in steps)})")
    if not names:
        raise Bad("--steps: expected names of steps")
    return [step for step in steps if any(is_or_begins(step.name, name) for name in names)]


def is_or_begins(step, name):
    return step == name or step.startswith(name + ".")


def missing_programs(steps, build):
    if not (ROOT / build).is_dir():
        return f"--build: there is no folder {build}"
    programs = sorted({program for step in steps for program in step.programs})
    missing = [str(program.relative_to(build)) for program in programs if not os.access(ROOT / program, os.X_OK)]
    return f"{build} lacks {', '.join(missing)} (tests/gpu/carry.sh makes such a build)" if missing else ""


def why_no_gpu(build):
    """Empty if there is a GPU: one that nvidia-smi lists, or one that plumbline can use."""
    smi = run(["nvidia-smi", "-L"], {}, 10, ROOT)
    if smi.code == 0 and re.search(r"^GPU \d+:", smi.out, re.M):
        return ""
    outcome = run([build / "plumbline", "--version"], {}, 15, ROOT)
    reading = readings.device(1 if outcome.code is None else outcome.code, outcome.out, outcome.err)
    if reading.status == readings.PASSED:
        return ""
    lines = (smi.err + smi.out).strip().splitlines()
    said = "did not end" if smi.code is None else lines[0] if lines else "lists none"
    return f"no GPU: {said if said.startswith('nvidia-smi') else f'nvidia-smi: {said}'}; plumbline: {reading.reason}"


def note_on_sources(build):
    """The tests read scenes and goldens from the folder where they were built."""
    cache = ROOT / build / "CMakeCache.txt"
    home = re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache.read_text(), re.M) if cache.is_file() else None
    if home and not Path(home[1], "scenes").is_dir():
        print(f"day.sh: note: the tests of this build read {home[1]}, which is not here: ln -s {ROOT} {home[1]}",
              file=sys.stderr)


def list_steps(steps):
    for step in steps:
        times = f", {step.rounds} rounds" if step.rounds > 1 else ""
        print(f"{step.name}: {step.what} (at most {step.limit} s{times})")
        for command in [*step.prepare, *step.commands]:
            print(f"    {command}")


def run_steps(steps, record, most):
    """Each step has its own limit, and up to as much again of the time that earlier steps left over. Stopping a
    command takes time, too: so `spare` can be negative, and all steps together keep to the sum of the limits."""
    spare = 0.0
    for step, entry in zip(steps, record.json["steps"]):
        limit = min(max(step.limit + spare, 1.0), 2 * step.limit, most or float("inf"))
        entry["limit_seconds"] = round(limit, 3)
        start = time.monotonic()
        if step.tool and not shutil.which(step.tool):
            entry["reason"] = f"{step.tool} is not installed"
        else:
            run_step(step, limit, ROOT, entry, record.save)
        spare += step.limit - (time.monotonic() - start)
        record.save()
        print(f"{entry['status']:9} {step.name} ({entry['seconds']:.1f} s)" +
              (f": {entry['reason']}" if entry["reason"] else ""), flush=True)


def exit_status(counts):
    if counts.get(readings.FAILED) or counts.get(readings.TIMED_OUT):
        return 1
    return NO_GPU if counts.get(readings.SKIPPED) else 0


def day(scratch):
    chosen = options()
    steps = chosen_steps(list(all_steps(chosen.build, scratch)), chosen.steps)
    missing = missing_programs(steps, chosen.build)
    carried = ROOT / chosen.build / "lib"
    if carried.is_dir():
        os.environ["LD_LIBRARY_PATH"] = ":".join(filter(None, (os.environ.get("LD_LIBRARY_PATH"), str(carried))))
    if chosen.dry_run:
        list_steps(steps)
    if missing:
        raise Bad(missing)
    absent = "--dry-run" if chosen.dry_run else why_no_gpu(chosen.build)
    record = Record(chosen.record, steps, chosen.build)
    if absent:
        if not chosen.dry_run:
            print(f"SKIPPED: {absent}. With a GPU these steps would run:")
            list_steps(steps)
        record.skip_all(absent)
        record.save()
        return 0 if chosen.dry_run else NO_GPU
    note_on_sources(chosen.build)
    record.save()
    try:
        run_steps(steps, record, chosen.limit)
    except KeyboardInterrupt:
        record.save()
        print(f"day.sh: interrupted; what was measured is in {record.path}", file=sys.stderr)
        return 130
    counts = record.json["counts"]
    print(f"{', '.join(f'{count} {status}' for status, count in counts.items())}, in {record.json['seconds']:.0f} s: "
          f"{record.path}")
    return exit_status(counts)


def main():
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        with tempfile.TemporaryDirectory(prefix="gpu_day_") as scratch:
            return day(scratch)
    except Bad as error:
        print(f"day.sh: {error}", file=sys.stderr)
    except OSError as error:
        print(f"day.sh: {error.filename}: {error.strerror}", file=sys.stderr)
    except KeyboardInterrupt:
        print("day.sh: interrupted", file=sys.stderr)
        return 130
    return 2


if __name__ == "__main__":
    sys.exit(main())
