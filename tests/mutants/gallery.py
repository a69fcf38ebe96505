"""Draws the gallery of bugs: ./run gallery [NAME...]

Each mutant that has a line Cause is applied to a copy of the sources, `plumbline` is built, and renders the scene as that
line says, with the same seed as the right program. The pictures are docs/images/bug_NAME.png. The sections of docs/bugs.md are
written from the heads of the mutants; gallery_page.py, an ordinary test, verifies that they are up to date.
"""

import argparse
import pathlib
import sys
import tempfile

import mutant
from gallery_page import PAGE, written
from gallery_picture import draw
from keep import alone, write_whole
from machine import processors
from mutants import found, guarded
from project import Project

PRESET = "release"
SIZE, SAMPLES = "120x80", "64"  # where a line Picture does not say
SECONDS = 300  # for a picture
PICTURES = mutant.ROOT / "docs" / "images"


class Renderer:
    """Renders with the program of a copy."""

    def __init__(self, project, copy):
        self.project, self.copy = project, copy

    def build(self, what):
        if error := self.project.build(self.copy.folder, PRESET, "plumbline"):
            raise RuntimeError(f"{what} does not build:\n{error}")

    def render(self, picture, path):
        """Renders as a line Picture says. Returns why there is no picture, or nothing."""
        words = picture.split()
        words += [] if "--size" in words else ["--size", SIZE]
        words += [] if "-s" in words else ["-s", SAMPLES]
        scene = str(self.copy.folder / words[0])
        ended = self.project.run(self.copy.folder, PRESET, "plumbline", ["render", scene, *words[1:], "-q", "-o", path], SECONDS)
        if ended.status is None:
            return f"it did not end in {SECONDS} seconds"
        return "" if ended.status == 0 else (ended.output.strip().splitlines() or [f"exit status {ended.status}"])[-1]


def size_of(path):
    with open(path, "rb") as file:
        file.readline()
        return tuple(map(int, file.readline().split()))


def right_pictures(renderer, chosen, folder):
    """The file with the right picture for each line Picture."""
    renderer.build("the unchanged program")
    pictures = {}
    for made in chosen:
        if made.picture not in pictures:
            pictures[made.picture] = path = pathlib.Path(folder, f"right{len(pictures)}.pfm")
            if why := renderer.render(made.picture, path):
                raise RuntimeError(f"{made.name}: the right program renders no picture: {why}")
    return pictures


def draw_mutant(renderer, made, right, folder):
    """Draws the picture of a mutant. Returns what became of it."""
    wrong = pathlib.Path(folder, "wrong.pfm")
    wrong.unlink(missing_ok=True)
    take_back = renderer.copy.change(made)
    if isinstance(take_back, str):
        raise RuntimeError(f"{made.name} does not apply: {take_back}")
    try:
        renderer.build(made.name)
        why = renderer.render(made.picture, wrong)
    finally:
        take_back()
    draw(right, None if why else wrong, *size_of(right), PICTURES / f"bug_{made.name}.png")
    return f"no picture: {why}" if why else "drawn"


def draw_all(project, chosen):
    copy = project.copy(0)
    copy.bring_up_to_date()
    renderer = Renderer(project, copy)
    with tempfile.TemporaryDirectory(prefix="plumbline-gallery-") as folder:
        print(f"{len(chosen)} pictures; first those of the right program", flush=True)
        right = right_pictures(renderer, chosen, folder)
        for number, made in enumerate(chosen, 1):
            print(f"{number} of {len(chosen)}, {made.name}: {draw_mutant(renderer, made, right[made.picture], folder)}", flush=True)


def main(argv):
    parser = argparse.ArgumentParser(prog="./run gallery", description="Draws the pictures of docs/bugs.md from the mutants, and writes its sections.")
    parser.add_argument("name", nargs="*", help="a mutant that has a line Cause; default: all")
    names = parser.parse_args(argv).name
    chosen = [made for made in found("mutant", mutant.kept, names, parser.error) if made.cause or names]
    if without := [made.name for made in chosen if not made.cause]:
        parser.error(f"{without[0]} has no line Cause")
    project = Project(builders=processors())
    with alone(project.place):
        draw_all(project, chosen)
    page = mutant.ROOT / PAGE
    write_whole(page, written(page.read_text(), mutant.kept()))
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main, "gallery"))
