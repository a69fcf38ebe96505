"""figures.toml: which commands draw which pictures of docs/images/, and what is wrong with the table or with the pages."""

import os
import re
import tomllib
from dataclasses import dataclass

TABLE = os.path.join("docs", "figures", "figures.toml")
PICTURES = os.path.join("docs", "images")
NEEDS = {"chromium", "course scenes"}


class Problem(Exception):
    """An error to be shown as one line."""


@dataclass(frozen=True)
class Figure:
    """An entry of the table; figures.toml explains the fields."""
    name: str
    pictures: tuple = ()
    draw: str = ""
    drawn_by: str = ""
    text: str = ""
    indent: int = 0
    compare: str = "bits"
    targets: tuple = ()
    needs: tuple = ()
    data: tuple = ()
    measured_by: str = ""
    seconds: int = 1


def read_table(root):
    """The figures of the table, in its order. Raises Problem if it is not in order."""
    try:
        with open(os.path.join(root, TABLE), "rb") as file:
            entries = tomllib.load(file)
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise Problem(f"{TABLE}: {error}") from None
    return [figure_of(name, entry) for name, entry in entries.items()]


def figure_of(name, entry):
    def complain(what):
        raise Problem(f"{TABLE}: [{name}]: {what}")

    if not isinstance(entry, dict):
        complain("it is a value, and not a table")
    fields = {}
    for key, value in entry.items():
        expected = Figure.__dataclass_fields__.get(key)
        if expected is None or key == "name":
            complain(f"unknown key {key}")
        if expected.type is tuple:
            if not (isinstance(value, list) and all(isinstance(item, str) for item in value)):
                complain(f"{key} must be a list of strings")
            value = tuple(value)
        if type(value) is not expected.type:
            complain(f"{key} must be of type {expected.type.__name__}")
        fields[key] = value
    figure = Figure(name, **fields)
    if bool(figure.draw) == bool(figure.drawn_by):
        complain("it needs either draw or drawn_by")
    if not figure.pictures and not figure.text:
        complain("it needs pictures or text")
    for picture in figure.pictures:
        if picture != os.path.basename(picture) or not picture.endswith((".png", ".svg")):
            complain(f"{picture} is no name of a .png or .svg in {PICTURES}")
    if figure.compare not in ("bits", "plot"):
        complain(f"compare is {figure.compare}, and not bits or plot")
    if bool(figure.data) != bool(figure.measured_by):
        complain("data needs measured_by, and measured_by data")
    for need in figure.needs:
        if need not in NEEDS:
            complain(f"needs {need}, which is none of {', '.join(sorted(NEEDS))}")
    return figure


def chosen(figures, names):
    """The figures with these names, or of these pictures; all if there are none."""
    if not names:
        return figures
    for name in names:
        if not any(name in (figure.name, *figure.pictures) for figure in figures):
            raise Problem(f"no such figure: {name} (./run figures --list lists them)")
    return [figure for figure in figures if not {figure.name, *figure.pictures}.isdisjoint(names)]


def begin_mark(name):
    return f"<!-- from here on written by ./run figures {name} -->"


END_MARK = "<!-- up to here -->"
ANY_MARK = re.compile(r"<!-- from here on written by \./run figures ([\w-]+) -->")
SHOWN = re.compile(r"""\]\(\s*<?([^)\s>]+\.(?:png|svg))|<img\b[^>]*?\bsrc=["']([^"']+\.(?:png|svg))["']""")


def pages(root):
    """The Markdown files of the root and of docs/, relative to the root."""
    found = [name for name in os.listdir(root) if name.endswith(".md")]
    for folder, _, names in os.walk(os.path.join(root, "docs")):
        found += [os.path.relpath(os.path.join(folder, name), root) for name in names if name.endswith(".md")]
    return sorted(found)


def read_page(root, page):
    with open(os.path.join(root, page), encoding="utf-8") as file:
        return file.read()


def written_part(text, page, name):
    """The start and end, in the text of a page, of the part that this figure writes. Raises Problem if it has none."""
    mark = begin_mark(name)
    if text.count(mark) != 1:
        raise Problem(f"{page}: it must have the line {mark} once, and has it {text.count(mark)} times")
    start = text.index(mark) + len(mark) + 1
    end = text.find(END_MARK, start)
    other = ANY_MARK.search(text, start)
    if end < 0 or (other and other.start() < end):
        raise Problem(f"{page}: {END_MARK} is missing after {mark}")
    return start, end


def faults(root, figures, compared=()):
    """What is wrong with table, pictures and pages, without drawing anything: a line each. Pictures of the figures `compared`
    may be missing, because that will be found when they are compared."""
    found = []
    count = {}
    for figure in figures:
        for picture in figure.pictures:
            count[picture] = count.get(picture, 0) + 1
    there = sorted(os.listdir(os.path.join(root, PICTURES)))
    for picture in there:
        if count.get(picture, 0) != 1:
            drawn = "no figure draws it" if picture not in count else "several figures draw it"
            found.append(f"{PICTURES}/{picture}: {drawn} ({TABLE})")
    found += [f"{PICTURES}/{picture}: missing" for figure in figures if figure not in compared
              for picture in figure.pictures if picture not in there]
    shown = set()
    known = {(figure.text, figure.name) for figure in figures if figure.text}
    for page in pages(root):
        text = read_page(root, page)
        for in_markdown, in_html in SHOWN.findall(text):
            picture = in_markdown or in_html
            if "://" in picture:
                continue
            path = os.path.normpath(os.path.join(os.path.dirname(page), picture))
            shown.add(path)
            if not os.path.isfile(os.path.join(root, path)):
                found.append(f"{page}: shows {path}, which is missing")
        found += [f"{page}: no figure {name} of {TABLE} writes text into it"
                  for name in ANY_MARK.findall(text) if (page, name) not in known]
    found += [f"{PICTURES}/{picture}: no page shows it" for picture in there
              if os.path.join(PICTURES, picture) not in shown]
    for figure in figures:
        if not figure.text:
            continue
        try:
            written_part(read_page(root, figure.text), figure.text, figure.name)
        except FileNotFoundError:
            found.append(f"{TABLE}: [{figure.name}]: there is no page {figure.text}")
        except Problem as problem:
            found.append(str(problem))
    return found
