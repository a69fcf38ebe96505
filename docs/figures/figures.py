"""Draws the pictures of docs/images/ with the commands of figures.toml, or verifies that they are what these draw.
Called by ./run figures, which builds what the commands need."""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time

from figure_compare import difference, text_difference
from figure_table import PICTURES, Problem, chosen, faults, read_page, read_table, written_part

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
HELP = """\
Each figure is drawn into a temporary folder, and then compared with what is in docs/images/ and in the pages:
the same pixels, or for plots, which a browser draws, coloured pixels at nearly the same places. Only what differs
is overwritten, and with --check nothing. Example: ./run figures --check extremes
Exit status: 1 if --check finds something stale or missing, 2 if something cannot be drawn."""


def options(arguments):
    parser = argparse.ArgumentParser(prog="./run figures", description="Draws the pictures of docs/images/ again.",
                                     epilog=HELP, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="figures or pictures [all that can be drawn here]")
    parser.add_argument("--check", action="store_true", help="overwrite nothing; say what is stale or missing")
    parser.add_argument("--list", action="store_true", help="list the figures and their pictures, and do no more")
    parser.add_argument("--table", action="store_true", help="check table, pictures and pages without drawing")
    parser.add_argument("--root", default=ROOT, help=argparse.SUPPRESS)
    parser.add_argument("--targets", action="store_true", help=argparse.SUPPRESS)
    return parser.parse_args(arguments)


def course_scenes():
    """Their folder; one that does not exist if $PLUMBLINE_SHARED does not name it."""
    return os.path.join(os.environ.get("PLUMBLINE_SHARED") or "/nowhere", "scenes")


def missing_need(figure, root):
    """What this machine lacks for a figure, or why ./run figures does not draw it; "" if it can."""
    if figure.drawn_by:
        return f"drawn by {figure.drawn_by}, with what it measures"
    if "course scenes" in figure.needs and not os.path.isdir(course_scenes()):
        return "it needs the course scenes, in the folder scenes/ of $PLUMBLINE_SHARED"
    if "chromium" in figure.needs and not shutil.which("chromium"):
        return "it needs chromium"
    for path in figure.data:
        if not os.path.exists(os.path.join(root, path)):
            return f"{path} is missing, which {figure.measured_by} writes"
    return ""


def draw(figure, root, scratch):
    """Runs the commands of a figure. Returns the folder with its pictures, and the text that they print."""
    images = os.path.join(scratch, figure.name, "images")
    own = os.path.join(scratch, figure.name, "scratch")
    os.makedirs(images)
    os.makedirs(own)
    environment = {**os.environ, "images": images, "scratch": own,
                   "plumbline": os.path.abspath(os.environ.get("PLUMBLINE", os.path.join(root, "build/release/plumbline"))),
                   "figures": os.path.join(root, "build/release/docs/figures"),
                   "course": course_scenes()}
    helpers = os.path.join(os.path.dirname(os.path.abspath(__file__)), "screenshot.sh")
    ran = subprocess.run(["bash", "-euo", "pipefail", "-c", f'source "{helpers}"\n{figure.draw}'], cwd=root, env=environment,
                         stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if ran.returncode != 0:
        last = (ran.stderr.strip() or "they say nothing").splitlines()[-1]
        raise Problem(f"{figure.name}: its commands failed with status {ran.returncode}: {last}")
    drawn = set(os.listdir(images))
    for what, names in (("did not draw", set(figure.pictures) - drawn), ("drew also", drawn - set(figure.pictures))):
        if names:
            raise Problem(f"{figure.name}: its commands {what} {', '.join(sorted(names))}")
    return images, ran.stdout


def new_text(figure, root, printed):
    """The page of a figure with what its commands printed, and the part before and after."""
    page = read_page(root, figure.text)
    start, end = written_part(page, figure.text, figure.name)
    part = "".join((" " * figure.indent + line).rstrip() + "\n" for line in printed.strip("\n").splitlines())
    part = f"\n{part.rstrip()}\n\n"
    return page[:start] + part + page[end:], page[start:end], part


def differences(figure, root, images, printed):
    """Yields each file of a figure, relative to the root, with why it is not what was drawn ("" if it is)."""
    for picture in figure.pictures:
        path = os.path.join(PICTURES, picture)
        old = os.path.join(root, path)
        yield path, difference(old, os.path.join(images, picture), figure.compare) if os.path.exists(old) else "missing"
    if figure.text:
        _, old, new = new_text(figure, root, printed)
        yield figure.text, text_difference(old, new)


def replace(path, content):
    """Writes a file to a temporary name and renames it, so that no half of it is left."""
    beside = f"{path}.new"
    try:
        with open(beside, "wb") as file:
            file.write(content)
        os.replace(beside, path)
    except OSError as error:
        if os.path.exists(beside):
            os.remove(beside)
        raise Problem(f"{path}: {error.strerror}") from None


def overwrite(figure, root, images, printed, path):
    if path == figure.text:
        replace(os.path.join(root, path), new_text(figure, root, printed)[0].encode())
        return
    with open(os.path.join(images, os.path.basename(path)), "rb") as file:
        replace(os.path.join(root, path), file.read())


def process(figure, given, scratch):
    """Draws one figure, and verifies or overwrites. Returns how many of its files are stale or missing."""
    images, printed = draw(figure, given.root, scratch)
    stale = 0
    for path, why in differences(figure, given.root, images, printed):
        stale += why != ""
        if why and not given.check:
            overwrite(figure, given.root, images, printed, path)
        print(f"  {path}: {'as drawn' if not why else why if why == 'missing' else f'stale: {why}'}"
              f"{', overwritten' if why and not given.check else ''}", flush=True)
    return stale


def run(given):
    figures = read_table(given.root)
    if given.list:
        for figure in figures:
            print(f"{figure.name}: {', '.join([*figure.pictures, *([figure.text] if figure.text else [])])}")
        return 0
    selected = chosen(figures, given.names)
    able = [figure for figure in selected if not missing_need(figure, given.root)]
    if given.targets:
        print("\n".join(dict.fromkeys(["plumbline", *(target for figure in able for target in figure.targets)])))
        return 0
    found = []
    if given.table or (given.check and not given.names):
        found = faults(given.root, figures, () if given.table else able)
        print(*found, sep="\n", end="\n" if found else "")
    if given.table:
        return 1 if found else 0
    left_out = [(figure, missing_need(figure, given.root)) for figure in selected if figure not in able]
    if given.names and left_out:
        raise Problem("; ".join(f"{figure.name}: {why}" for figure, why in left_out))
    if not given.check and able:
        files = [os.path.join(PICTURES, picture) for figure in able for picture in figure.pictures]
        print("May be overwritten:", *files, *dict.fromkeys(figure.text for figure in able if figure.text), sep="\n  ")
    seconds = sum(figure.seconds for figure in able)
    print(f"Figures: {len(able)}, about {f'{seconds} s' if seconds < 90 else f'{round(seconds / 60)} minutes'}", flush=True)
    stale = 0
    problems = []
    with tempfile.TemporaryDirectory(prefix="plumbline-figures-") as scratch:
        for number, figure in enumerate(able, 1):
            start = time.monotonic()
            print(f"[{number}/{len(able)}] {figure.name}", flush=True)
            try:
                stale += process(figure, given, scratch)
            except Problem as problem:
                print(f"  {problem}", file=sys.stderr, flush=True)
                problems.append(problem)
            if sys.stderr.isatty():
                print(f"  {time.monotonic() - start:.0f} s", file=sys.stderr)
    for figure, why in left_out:
        print(f"Not {'checked' if given.check else 'drawn'}: {figure.name}: {why}")
    if problems:
        print(f"./run figures: {len(problems)} figures could not be drawn", file=sys.stderr)
        return 2
    if not given.check:
        for line in [] if given.names else faults(given.root, figures):
            print(f"Note: {line}")
        return 0
    count = stale + len(found)
    print("Everything is as drawn." if count == 0 else f"{count} stale, missing or unknown")
    return 1 if count else 0


def main(arguments):
    try:
        return run(options(arguments))
    except Problem as problem:
        print(f"./run figures: {problem}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
