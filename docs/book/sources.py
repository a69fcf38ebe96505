"""Sources in the book: which ones the pages refer to, and where a name stands in one.

A page refers to a source in two ways: by a link, as in [refit.h](../ref/trees/refit.h#L37), or by its path in code font,
which may be followed by a name: `ref/trees/refit.h`: `refit`. In the book both lead to a copy of the source with a number
at each line.
"""

import posixpath
import re
from pathlib import Path

LINK = re.compile(r"\]\(([^)\s#:]+)(#[^)\s]*)?\)")
PATH = r"[A-Za-z0-9_.-]+(?:/[A-Za-z0-9_.-]+)*\.(?:h|cpp|cu|cuh|py|sh|cmake|dae|toml)"
CODE_PATH = re.compile(rf"`({PATH})`")
LARGEST = 200_000  # bytes; some scene files are megabytes of numbers


def target_of(link: str, page: str) -> str | None:
    """The path from the root of the repository to what `link` names on `page` (a path in docs/), or None if that is a
    page or picture of docs/."""
    path = posixpath.normpath(posixpath.join("docs", posixpath.dirname(page), link))
    return None if path.startswith("docs/") and path.endswith((".md", ".png", ".svg")) else path


def is_listed(root: Path, path: str) -> bool:
    """Whether the book can show `path`: a file of text that is not too long, in the repository."""
    file = root / path
    return not path.startswith("..") and file.is_file() and file.stat().st_size <= LARGEST


def referenced(root: Path, page: str, text: str) -> set[str]:
    """The files and folders that the text of a page refers to; those of a folder that is linked, too."""
    found = {path for path in CODE_PATH.findall(text) if is_listed(root, path)}
    for link, _ in LINK.findall(text):
        path = target_of(link, page)
        if path is None or path.startswith(".."):
            continue
        found.add(path)
        if (root / path).is_dir():
            found |= {f"{path}/{file}" for file in files_in(root / path) if is_listed(root, f"{path}/{file}")}
    return {path for path in found if is_listed(root, path) or (root / path).is_dir()}


def files_in(folder: Path) -> list[str]:
    """The names of the files of a folder."""
    return sorted(file.name for file in folder.iterdir() if file.is_file())


def page_of(path: str) -> str:
    """The page of the book, as a path in docs/, that shows a source."""
    return f"source/{path}.md"


def with_links_to_pages(root: Path, page: str, text: str) -> str:
    """The text of a page with its links to sources replaced by links to their pages in the book."""

    def replace(match: re.Match) -> str:
        path = target_of(match[1], page)
        if path is None or not (is_listed(root, path) or (root / path).is_dir()):
            return match[0]  # MkDocs reports what does not exist
        return f"]({posixpath.relpath(page_of(path), posixpath.dirname(page) or '.')}{match[2] or ''})"

    return LINK.sub(replace, text)


def line_of(source: str, name: str) -> int | None:
    """The number of the line where `name` is declared: the first one that is not indented, or else the first one; comments do not
    count. None if no line has the name."""
    word = re.compile(rf"(?<![A-Za-z0-9_]){re.escape(name.split('::')[-1])}(?![A-Za-z0-9_])")
    lines = [number for number, line in enumerate(source.splitlines(), 1)
             if word.search(re.sub(r"//.*|^\s*#.*", "", line))]
    unindented = [number for number in lines if not source.splitlines()[number - 1][:1].isspace()]
    return next(iter(unindented or lines), None)


def with_links_to_names(root: Path, listed: set[str], page_url: str, html: str) -> str:
    """The HTML of a page with links at each path in code font, and at the name that follows it. `listed`: the sources that
    have a page in the book."""
    code = re.compile(rf"<code>({PATH})</code>(?:(:\s+)<code>([A-Za-z0-9_:]+)</code>)?")

    def replace(match: re.Match) -> str:
        path, between, name = match.groups()
        if path not in listed:
            return match[0]
        url = posixpath.relpath(f"source/{path}.html", posixpath.dirname(page_url) or ".")
        linked = f'<a class="source" href="{url}"><code>{path}</code></a>'
        if name is None:
            return linked
        line = line_of((root / path).read_text(encoding="utf-8"), name)
        if line is None:
            return f"{linked}{between}<code>{name}</code>"
        return f'{linked}{between}<a class="source" href="{url}#L{line}"><code>{name}</code></a>'

    # What is a link already stays as it is.
    parts = re.split(r"(<a\b.*?</a>)", html, flags=re.DOTALL)
    return "".join(part if part.startswith("<a") else code.sub(replace, part) for part in parts)
