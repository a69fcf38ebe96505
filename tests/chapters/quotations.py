"""Compares the code that docs/derivations.md quotes with the files, and finds the tests that it names.

A quotation is a block of C++ whose first line is a comment with the file. Its other lines are lines of that file, in this
order; indentation and comments do not count. quotations.py prints what is wrong, and exits with 1 if anything is.
"""

import re
import sys

from source_text import ROOT, without_comments

PAGE = "docs/derivations.md"
FEWEST_QUOTATIONS = 12  # fewer means that the page was not understood


def code_lines(text):
    return [line.strip() for line in without_comments(text).splitlines() if line.strip()]


def quotations(page):
    """Pairs of file and lines."""
    return [
        (file, code_lines(lines))
        for file, lines in re.findall(r"```cpp\n// (\S+)\n(.*?)```", page, re.DOTALL)
    ]


def lost_line(file, lines):
    """The first line that does not follow the one before it in the file; None if all do."""
    rest = iter(code_lines((ROOT / file).read_text()))
    return next((line for line in lines if line not in rest), None)


def sections_without(page, pattern):
    """The titles of the numbered sections in which a pattern is not found."""
    sections = re.split(r"^## (?=\d+\. )", page.split("\n## References")[0], flags=re.MULTILINE)[1:]
    return [section.splitlines()[0] for section in sections if not re.search(pattern, section)]


def main():
    page = (ROOT / PAGE).read_text()
    found = quotations(page)
    faults = []
    for file, lines in found:
        if not (ROOT / file).is_file():
            faults.append(f"there is no {file}")
        elif lost_line(file, lines) is not None:
            faults.append(f"{file} has no line, or not in this order: {lost_line(file, lines)}")
    faults += [f"section {title} quotes no code" for title in sections_without(page, "```cpp")]
    faults += [f"section {title} names no check" for title in sections_without(page, r"Check: `tests/")]
    if len(found) < FEWEST_QUOTATIONS or page.count("```cpp") != len(found):
        faults.append("a quotation is not understood")
    for fault in faults:
        print(f"{PAGE}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
