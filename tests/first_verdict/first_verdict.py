"""Measures the minutes from `git clone` to the first verdict, for somebody who has a tree builder or a renderer, and counts
the lines that he writes. Clones what is committed here into a temporary folder, and does there what README.md and
docs/own-code.md say. ./run firstverdict calls this. Prints the paragraph of docs/own-code.md on standard output."""

import argparse
import datetime
import os
import shlex
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.append(os.path.join(ROOT, "tests", "peers"))

from machine import describe, load, processor

BUILDER = "examples/own_builder.py"
RENDERER = "examples/own_renderer.sh"
PLACEHOLDERS = ["{scene}", "{out}", "{width}", "{height}", "{samples}", "{seed}", "{max_edges}"]
BEGIN, END = "<!-- first verdict: begin -->", "<!-- first verdict: end -->"


def options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--largest", type=int, default=4096, help="most primitives of the builder's inputs [4096]")
    parser.add_argument("--scenes", help="of the renderer, separated by commas [all]")
    parser.add_argument("--ccache", action="store_true", help="take compiled files from the compiler cache: only to try this script")
    parser.add_argument("--page", help="write the paragraph into this page, between its marks: docs/own-code.md")
    return parser.parse_args()


def lines_of(path):
    """The lines of a program that are not empty, no comment and not its description."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    if path.endswith(".py") and text.startswith('"""'):
        text = text.split('"""', 2)[2]
    return sum(bool(line.strip()) and not line.strip().startswith("#") for line in text.splitlines())


class Steps:
    """Runs commands in the clone, and keeps their minutes. Their output goes to standard error."""

    def __init__(self, clone, environment):
        self.clone = clone
        self.environment = environment
        self.minutes = {}

    def run(self, name, command, expected=(0,), folder=None):
        print(f"\n$ {shlex.join(command)}", file=sys.stderr, flush=True)
        start = time.monotonic()
        status = subprocess.run(command, cwd=folder or self.clone, env=self.environment, stdout=sys.stderr,
                                stdin=subprocess.DEVNULL, check=False).returncode
        self.minutes[name] = (time.monotonic() - start) / 60
        if status not in expected:
            sys.exit(f"first_verdict.py: {command[0]} ended with exit status {status}")
        return status


def measured(given, folder):
    """Minutes by step, and the exit status of the renderer's check."""
    clone = os.path.join(folder, "plumbline")
    environment = {**os.environ, "PATH": os.path.join(clone, "build", "release") + os.pathsep + os.environ["PATH"]}
    if given.ccache:
        environment |= {"CCACHE_BASEDIR": clone, "CCACHE_NOHASHDIR": "1", "CCACHE_SLOPPINESS": "time_macros"}
    else:
        environment["CCACHE_DISABLE"] = "1"
    steps = Steps(clone, environment)
    steps.run("clone", ["git", "clone", "--quiet", "--no-local", ROOT, clone], folder=folder)
    steps.run("demo", ["./run", "demo"])
    steps.run("builder", ["plumbline", "check-builder", "-q", "--largest", str(given.largest), "--", "python3", BUILDER,
                          "{primitives}", "{tree}"])
    scenes = ["--scenes", given.scenes] if given.scenes else []
    first = ["plumbline", "check-renderer", "-q", "--scenes", "cornell_diffuse", "--", RENDERER, *PLACEHOLDERS]
    steps.run("scene", first)
    # Inconclusive, 3, is a verdict too: a golden may have more noise than is required.
    steps.run("renderer", ["plumbline", "check-renderer", "-q", *scenes, "--", RENDERER, *PLACEHOLDERS], expected=(0, 3))
    return steps.minutes


def paragraph(given, minutes, before):
    builder, renderer = (lines_of(os.path.join(ROOT, name)) for name in (BUILDER, RENDERER))
    start = minutes["clone"] + minutes["demo"]
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    cached = "; compiled files from a cache, so the build says nothing" if given.ccache else ""
    return "\n".join([
        f"`./run firstverdict`, {datetime.date.today():%-d %B %Y}, {processor()}, {describe(before)} before; commit {commit.strip()}; "
        f"Debian's packages were installed before{cached}:", "",
        "| | minutes, a builder | minutes, a renderer |", "|---|---|---|",
        f"| `git clone`, from this machine | {minutes['clone']:.1f} | {minutes['clone']:.1f} |",
        f"| `./run demo`: build, and a picture | {minutes['demo']:.1f} | {minutes['demo']:.1f} |",
        f"| the first verdict: `check-builder` up to {given.largest} primitives; `check-renderer`, one scene "
        f"| {minutes['builder']:.1f} | {minutes['scene']:.1f} |",
        f"| **from clone to verdict** | **{start + minutes['builder']:.1f}** | **{start + minutes['scene']:.1f}** |",
        f"| `check-renderer`, {given.scenes or 'all scenes'} | | {minutes['renderer']:.1f} |",
        f"| lines that the user writes | {builder} (`{BUILDER}`) | {renderer} (`{RENDERER}`) |"])


def write_page(path, text):
    with open(path, encoding="utf-8") as file:
        page = file.read()
    if page.count(BEGIN) != 1 or page.count(END) != 1:
        sys.exit(f"first_verdict.py: {path}: not exactly one {BEGIN} and {END}")
    with open(path, "w", encoding="utf-8") as file:
        file.write(page.partition(BEGIN)[0] + BEGIN + "\n" + text + "\n" + END + page.partition(END)[2])


def main():
    given = options()
    before = load()
    with tempfile.TemporaryDirectory(prefix="plumbline_first_verdict_") as folder:
        minutes = measured(given, folder)
    text = paragraph(given, minutes, before)
    print(text)
    if given.page:
        write_page(given.page, text)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)
