"""Holds the pseudocode of docs/one-sample.md to the code.

A block starts with a line without indentation, which names a function; its other lines name, in order, what the body of
that function uses. pseudocode.py prints what is wrong, and exits with 1 if anything is.
"""

import re
import sys

from source_text import ROOT, bodies, file_text, in_order, word

PAGE = "docs/one-sample.md"
LINE = re.compile(r"(?P<text>.*\S) +(?P<name>[A-Za-z_]+) +(?P<file>[a-z_/]+\.(?:h|cpp))")
FEWEST_LINES = 80  # of both integrators: fewer means that the lines were not understood


def path_of(file):
    return file if "/" in file else "ref/transport/" + file


def blocks(page):
    """Lists of (text, function, file), one for each block; lines without a function are left out."""
    found = []
    for code in re.findall(r"```text\n(.*?)```", page, re.DOTALL):
        for line in code.splitlines():
            match = LINE.fullmatch(line)
            if match and not line.startswith(" "):
                found.append([])
            if match:
                found[-1].append((match["text"], match["name"], path_of(match["file"])))
    return found


def faults_of_block(block):
    faults = []
    for _, name, file in block:
        code = file_text(file)
        if code is None:
            faults.append(f"there is no {file}")
        elif not word(name).search(code):
            faults.append(f"{file} has no {name}")
    if faults:
        return faults
    _, function, file = block[0]
    failures = [in_order(body, [name for _, name, _ in block[1:]]) for body in bodies(file_text(file), function)]
    if not failures:
        faults.append(f"{file} does not define {function}")
    elif all(failures):
        faults.append(f"{file}: {function} does not use {failures[0]}, or not in this order")
    return faults


def faults_of_events(page):
    """The random numbers in brackets must be those of all events, and only of them."""
    enumerators = re.search(r"enum class Event[^{]*\{(.*?)\}", file_text("ref/transport/random.h"), re.DOTALL)[1]
    events = set(re.findall(r"[a-z_]+", enumerators))
    code = "".join(re.findall(r"```text\n(.*?)```", page, re.DOTALL))
    named = set()
    for bracket in re.findall(r"\[([a-z_][^\]:]*):", code):
        named |= set(re.findall(r"[a-z]+_[a-z]+|camera", bracket))
    return [f"random numbers of {event}: in only one of code and pseudocode" for event in sorted(events ^ named)]


def main():
    page = (ROOT / PAGE).read_text()
    found = blocks(page)
    faults = [fault for block in found for fault in faults_of_block(block)] + faults_of_events(page)
    if sum(len(block) for block in found) < FEWEST_LINES:
        faults.append("the lines of pseudocode are not understood")
    for fault in faults:
        print(f"{PAGE}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
