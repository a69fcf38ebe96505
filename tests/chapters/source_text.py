"""The sources as text: the bodies of functions, and names in them."""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]


def without_comments(text):
    """C++ text without comments, whose words would hide that a name is gone from the code."""
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)


def file_text(name):
    """The code of a file, given by its path from the root; None if there is no such file."""
    path = ROOT / name
    return without_comments(path.read_text()) if path.is_file() else None


def word(name):
    return re.compile(r"(?<![A-Za-z0-9_])" + re.escape(name) + r"(?![A-Za-z0-9_])")


def bodies(code, function):
    """The texts between the braces of all definitions of a function (overloads have one each)."""
    found = []
    for match in word(function).finditer(code):
        at = end_of_group(code, match.end(), "(", ")")
        between = re.compile(r"(?:\s|const|override|noexcept)*\{").match(code, at) if at else None
        if between:
            found.append(code[between.end() : end_of_group(code, between.end() - 1, "{", "}")])
    return found


def end_of_group(code, at, opening, closing):
    """The place after the bracket that closes the one at `at`; None if there is no bracket."""
    if code[at : at + 1] != opening:
        return None
    depth = 0
    for i in range(at, len(code)):
        depth += (code[i] == opening) - (code[i] == closing)
        if depth == 0:
            return i + 1
    return None


def in_order(body, names):
    """The first of the names that does not follow the one before it in the text; None if all do. A name may follow
    itself at the same place: two lines of pseudocode may be one line of code."""
    at = 0
    for name in names:
        match = word(name).search(body, at)
        if match is None:
            return name
        at = match.start()
    return None
