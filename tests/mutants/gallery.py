"""Draws the gallery of bugs: ./run gallery [NAME...]

Each mutant of tests/mutants/patches/ that has a line Picture is applied to a copy of the sources, `plumbline` is built, and
renders the scene as that line says, with the same seed as the right program: docs/images/bug_NAME.png. The sections of
docs/bugs.md are written from the heads of the mutants (the first half of ./run test verifies that they are up to date:
gallery_page.py)."""

import argparse
import os
import pathlib
import sys
import tempfile

from gallery_page import PAGE, written
from gallery_picture import draw
from mutant import ROOT, Fault, patches
from processes import Interrupted, Processes
from sandbox import Sandbox

SIZE = (120, 80)
SAMPLES = 64
LIMIT = 300  # seconds for a picture
PICTURES = ROOT / "docs" / "images"


def render(processes, program, picture, path, cwd):
    """Renders with the words of a line Picture. Returns why there is no picture, or ""."""
    words = picture.split()
    if "--size" not in words:
        words += ["--size", f"{SIZE[0]}x{SIZE[1]}"]
    if "-s" not in words:
        words += ["-s", str(SAMPLES)]
    ended = processes.run([str(program), "render", *words, "-q", "-o", path], LIMIT, cwd=cwd)
    if ended.status is None:
        return f"it did not end in {LIMIT} s"
    return "" if ended.status == 0 else (ended.output.strip().splitlines() or [f"status {ended.status}"])[-1]


def size_of(path):
    with open(path, "rb") as file:
        file.readline()
        return tuple(int(word) for word in file.readline().split())


def right_pictures(mutants, sandbox, processes, folder):
    """The picture of the right program for each line Picture."""
    seconds, why = sandbox.build("plumbline", "")
    if why:
        raise Fault(f"the unchanged sources do not build: {why}")
    found = {}
    for mutant in mutants:
        if mutant.picture not in found:
            path = os.path.join(folder, f"right{len(found)}.pfm")
            if why := render(processes, plumbline(sandbox), mutant.picture, path, sandbox.sources):
                raise Fault(f"{mutant.name}: the right program renders no picture: {why}")
            found[mutant.picture] = path
    return found


def plumbline(sandbox):
    return sandbox.folder("") / "plumbline"


def draw_mutant(mutant, right, sandbox, processes, folder):
    """Writes the picture of a mutant. Raises Fault."""
    wrong = os.path.join(folder, "wrong.pfm")
    pathlib.Path(wrong).unlink(missing_ok=True)
    if why := sandbox.apply(mutant.diff):
        raise Fault(f"{mutant.name} does not apply: {why}")
    try:
        _, why = sandbox.build("plumbline", "")
        if why:
            raise Fault(f"{mutant.name} does not build: {why}")
        why = render(processes, plumbline(sandbox), mutant.picture, wrong, sandbox.sources)
    finally:
        sandbox.restore()
    draw(right, None if why else wrong, *size_of(right), PICTURES / f"bug_{mutant.name}.png")
    return f"no picture: {why}" if why else "drawn"


def main():
    parser = argparse.ArgumentParser(prog="./run gallery", description="Draws the pictures of docs/bugs.md from the mutants, and writes its sections.")
    parser.add_argument("name", nargs="*", help="a mutant that has a line Picture; default: all")
    names = parser.parse_args().name
    mutants = [mutant for mutant in patches(names) if mutant.picture or names]
    for mutant in mutants:
        if not mutant.picture:
            raise Fault(f"{mutant.name} has no line Picture")
    processes = Processes()
    sandbox = Sandbox("gallery", os.cpu_count() or 1, processes)
    sandbox.restore()
    with tempfile.TemporaryDirectory(prefix="plumbline-gallery-") as folder:
        print(f"{len(mutants)} pictures; first those of the right program", flush=True)
        right = right_pictures(mutants, sandbox, processes, folder)
        for number, mutant in enumerate(mutants, 1):
            print(f"{number} of {len(mutants)}, {mutant.name}: {draw_mutant(mutant, right[mutant.picture], sandbox, processes, folder)}", flush=True)
    page = ROOT / PAGE
    page.write_text(written(page.read_text(encoding="utf-8"), patches()), encoding="utf-8")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Fault as fault:
        sys.exit(f"gallery: {fault}")
    except (KeyboardInterrupt, Interrupted):
        sys.exit(130)
