"""The map from formulas to code: docs/map.md, made of docs/map.toml and of the tags in the sources.

    map.py ROOT                  writes docs/map.md
    map.py ROOT --check          exit status 1, and what is wrong, unless map and tags are complete and up to date
    map.py ROOT --run PLUMBLINE  runs the commands of the table: each must print the words that the table gives

A tag stands at the end of a comment, on the line that computes a formula or just above it: "// map: fresnel". It may name several
steps, and cite the source of the last: "// map: area-conversion [Veach 1997, eq. 8.10]". In tests/ it stands on the first
line of a test, or above it.
"""
import difflib
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
from typing import NamedTuple

BEGIN = "<!-- from here on written by ./run map -->\n"
END = "<!-- up to here -->\n"
TAG = re.compile(r"//(?: .*;)? map: (.*)")  # after all other words of the comment
STEPS = re.compile(r"([a-z][a-z0-9-]*(?:, [a-z][a-z0-9-]*)*)(?: \[([^\]]+)\])?")
TEST = re.compile(r"(?:TEST|TEST_P|TEST_F|TYPED_TEST|RC_GTEST_PROP)\(\s*(\w+),\s*(\w+)")
SOURCES = {".h", ".cpp", ".cu", ".cuh"}
# The columns of the map, and the folders whose tags stand in them. images/ serves both wings.
COLUMNS = {"ref": ("ref", "images"), "cuda": ("cuda", "images"), "tests": ("tests",)}


class Tag(NamedTuple):
    file: str
    line: int
    code: int  # the line that it is about: its own, or where that is a comment alone, the next that is not
    name: str
    citation: str | None
    test: str | None  # Suite.Name, in tests/


def tags_of(root: pathlib.Path) -> tuple[list[Tag], list[str]]:
    """All tags, in the order of files and lines, and what is wrong with them."""
    tags, errors = [], []
    files = (f for folder in ("ref", "cuda", "images", "tests") for f in (root / folder).rglob("*"))
    for path in sorted(f for f in files if f.suffix in SOURCES):
        lines = path.read_text(encoding="utf-8").split("\n")
        file = path.relative_to(root).as_posix()
        for number, line in enumerate(lines, 1):
            found = TAG.search(line)
            if not found:
                continue
            code = code_at(lines, number)
            test = test_at(lines, code) if file.startswith("tests/") else None
            if file.startswith("tests/") and test is None:
                errors.append(f"{file}:{number}: a tag in tests/ stands on the first line of a test, or above it")
            steps = STEPS.fullmatch(found[1])
            if steps is None:
                errors.append(f'{file}:{number}: a tag is "map: step, step [source]" and ends its line, not "{found[0]}"')
                continue
            names = steps[1].split(", ")
            tags += [Tag(file, number, code, n, steps[2] if n == names[-1] else None, test) for n in names]
    return tags, errors


def code_at(lines: list[str], number: int) -> int:
    """The line `number`, or if it is a comment alone, the next that is not. Lines are counted from 1."""
    while number < len(lines) and lines[number - 1].lstrip().startswith("//"):
        number += 1
    return number


def test_at(lines: list[str], number: int) -> str | None:
    """The test that begins on line `number`."""
    found = TEST.match("\n".join(lines[number - 1 : number + 1]))
    return f"{found[1]}.{found[2]}" if found else None


def in_column(tags: list[Tag], step: dict, column: str) -> list[Tag]:
    """The tags of a cell; tests of the reference come first."""
    found = [t for t in tags if t.name == step["name"] and t.file.split("/")[0] in COLUMNS[column]]
    return sorted(found, key=lambda t: t.file.startswith("tests/cuda/"))


def errors_of_tags(tags: list[Tag], steps: list[dict]) -> list[str]:
    errors = []
    by_name = {step["name"]: step for step in steps}
    for tag in tags:
        place = f"{tag.file}:{tag.line}"
        if tag.name not in by_name:
            near = difflib.get_close_matches(tag.name, by_name, 1)
            hint = f"; there is {near[0]}" if near else ""
            errors.append(f"{place}: no step of docs/map.toml is called {tag.name}{hint}")
        elif tag.citation is not None and tag.citation not in by_name[tag.name]["paper"].split("; "):
            errors.append(f'{place}: cites [{tag.citation}], and docs/map.toml "{by_name[tag.name]["paper"]}"')
    for step in steps:
        name = step["name"]
        missing = f"no line in %s has the tag // map: {name}"
        if not in_column(tags, step, "ref"):
            errors.append(f"docs/map.toml: {name}: {missing % 'ref/ or images/'}")
        has_cuda = bool(in_column(tags, step, "cuda"))
        if has_cuda == ("no_cuda" in step):
            what = "no_cuda, and there are tags in cuda/" if has_cuda else missing % "cuda/ or images/" + ", and it has no no_cuda"
            errors.append(f"docs/map.toml: {name}: {what}")
        tested = {t.file.split("/")[1] for t in in_column(tags, step, "tests")}
        for wing in sorted({t.file.split("/")[0] for t in tags if t.name == name and t.test is None} - {"tests"}):
            if wing not in tested:
                errors.append(f"docs/map.toml: {name}: {missing % f'tests/{wing}/'}")
    return errors


def errors_of_table(root: pathlib.Path, table: dict) -> list[str]:
    errors = []
    names = [step["name"] for step in table["step"]]
    for name in sorted({name for name in names if names.count(name) > 1}):
        errors.append(f"docs/map.toml: two steps are called {name}")
    used = set()
    for step in table["step"]:
        where = f"docs/map.toml: {step['name']}"
        if found := re.search(r"[|<>*$]|\\[^A-Za-z ]", step["formula"]):
            errors.append(f"{where}: Markdown would change {found[0]} in the formula")
        if not step["shows"]:
            errors.append(f"{where}: neither a command nor a figure shows it")
        for target, _ in step["shows"]:
            used.add(target)
            if target not in table["commands"]:
                errors += [f"{where}: {why}" for why in errors_of_link(root / "docs", target)]
    errors += [f"docs/map.toml: no step uses the command {name}" for name in table["commands"] if name not in used]
    return errors


def slug(heading: str) -> str:
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def errors_of_link(docs: pathlib.Path, target: str) -> list[str]:
    page, _, anchor = target.partition("#")
    if not (docs / page).is_file():
        return [f"there is no command {target}, and no file docs/{page}"]
    headings = re.findall(r"^#+ (.*)$", (docs / page).read_text(encoding="utf-8"), re.M)
    return [] if not anchor or anchor in map(slug, headings) else [f"docs/{page} has no heading #{anchor}"]


def link_text(tag: Tag) -> str:
    """Of a test its name as words, which a narrow column can break."""
    if tag.test is None:
        return f"{pathlib.Path(tag.file).name}:{tag.code}"
    suite, name = tag.test.split(".")
    return suite + ":" + re.sub("[A-Z]", lambda letter: " " + letter[0].lower(), name)


def row(step: dict, tags: list[Tag], commands: dict) -> str:
    paper = f" [{step['paper']}]" if step["paper"] else ""
    cells = [f"<a id=\"{step['name']}\"></a>**{step['title']}**{paper}<br> ${step['formula']}$"]
    for column in COLUMNS:
        links = [f"[{link_text(t)}](../{t.file}#L{t.code})" for t in in_column(tags, step, column)]
        cells.append("<br>".join(links) or step["no_cuda"])
    shows = [
        f"[{target}](#command-{target}): `{words}`" if target in commands else f"[{words}]({target})"
        for target, words in step["shows"]
    ]
    return "| " + " | ".join(cells + ["<br>".join(shows)]) + " |\n"


def written(table: dict, tags: list[Tag]) -> str:
    """The part of docs/map.md between the marks."""
    text = ""
    for step in table["step"]:
        if "section" in step:
            text += f"\n## {step['section']}\n\n| formula | `ref` | `cuda` | tests | shown by |\n|---|---|---|---|---|\n"
        text += row(step, tags, table["commands"])
    text += "\n## Commands\n\n| name | command |\n|---|---|\n"
    for name, command in table["commands"].items():
        text += f'| <a id="command-{name}"></a>{name} | `{command}` |\n'
    return text + "\n"


def run_commands(root: pathlib.Path, table: dict, plumbline: str) -> list[str]:
    errors = []
    with tempfile.TemporaryDirectory() as folder:
        for name, command in table["commands"].items():
            program, *arguments = shlex.split(command)
            assert program == "plumbline", command
            # What it writes goes to the folder; what it reads is named from the root.
            arguments = [a if not a.endswith(".exr") else f"{folder}/{a}" for a in arguments]
            done = subprocess.run([plumbline, *arguments], cwd=root, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                errors.append(f"docs/map.toml: {name} ends with status {done.returncode}: {done.stderr.strip()}")
                continue
            errors += [
                f'docs/map.toml: {step["name"]}: the command {name} does not print "{words}"'
                for step in table["step"] for target, words in step["shows"] if target == name and words not in done.stdout
            ]
    return errors


def main(root: pathlib.Path, option: str = "", plumbline: str = "") -> int:
    table = tomllib.loads((root / "docs/map.toml").read_text(encoding="utf-8"))
    tags, errors = tags_of(root)
    errors += errors_of_table(root, table) + errors_of_tags(tags, table["step"])
    page = root / "docs/map.md"
    if option == "--run":
        errors = run_commands(root, table, plumbline)
    elif not errors:
        before, _, rest = page.read_text(encoding="utf-8").partition(BEGIN)
        after = rest.partition(END)[2]
        new = before + BEGIN + written(table, tags) + END + after
        if option == "":
            page.write_text(new, encoding="utf-8")
        elif new != page.read_text(encoding="utf-8"):
            old = set(rest.split("\n"))
            changed = [line for line in written(table, tags).split("\n") if line not in old]
            names = [found[1] for line in changed if (found := re.search(r'<a id="([^"]+)"', line))]
            errors.append(f"docs/map.md is not up to date ({', '.join(names) or 'rows'}): ./run map renews it")
    for error in errors:
        print(error)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), *sys.argv[2:]))
