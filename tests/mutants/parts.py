"""The part of a test program that holds some of its tests: these tests' object files, and those that they need.

A mistake in a header changes nearly every object file of a program. Few of them matter to the tests that are run, so only these
are compiled. Which they are is found as a linker finds it in archives: an object file is needed if it defines a symbol that
another needed one uses.
"""

import re
import shlex
import subprocess
from typing import NamedTuple

import gtest

TEST_BODY = re.compile(r"(\w+_Test)(?:I.*)?8TestBodyEv$")  # as compilers of Linux write Suite_Name_Test::TestBody()


class Part(NamedTuple):
    """`targets`: what ninja builds for it. `link`: the command that makes `file` of it, relative to the folder of the build."""

    targets: tuple[str, ...]
    link: tuple[str, ...]
    file: str


class Objects(NamedTuple):
    """The object files of a test program and of its libraries. `own`: of the program itself. `defined`, `weak`, `used`: symbols by
    object file. `bodies`: the classes of tests as compilers write them, by object file. `programs`: what the program may start,
    by its path. `link`: the words of the command that links the program."""

    own: list[str]
    defined: dict[str, set[str]]
    weak: dict[str, set[str]]
    used: dict[str, set[str]]
    bodies: dict[str, set[str]]
    programs: dict[str, set[str]]
    link: list[str]

    def with_tests(self):
        """The object files that hold tests."""
        return [file for file in self.own if self.bodies[file]]

    def of_tests(self, tests):
        """The object files that hold these tests; None if one of them is in none."""
        found = []
        for test in tests:
            files = [file for file in self.own if any(_is_body_of(test, body) for body in self.bodies[file])]
            if not files:
                return None
            found += files
        return list(dict.fromkeys(found))

    def needed(self, files):
        """`files` and all others that they need."""
        found, waiting = list(files), list(files)
        known = set().union(*(self.defined[file] | self.weak[file] for file in files))
        while waiting:
            for symbol in sorted(self.used[waiting.pop()]):
                if symbol not in known and (file := self._definer(symbol)):
                    found.append(file)
                    waiting.append(file)
                    known |= self.defined[file] | self.weak[file]
        return found

    def _definer(self, symbol):
        for symbols in (self.defined, self.weak):
            if file := next((file for file in symbols if symbol in symbols[file]), None):
                return file
        return None

    def part(self, files, name):
        """The part that holds the tests of these object files, as the program `name` in the program's folder."""
        needed = self.needed(files)
        output = self.link.index("-o") + 1
        file = self.link[output].rpartition("/")[0] + "/" + name
        words = [file if i == output else word for i, word in enumerate(self.link) if word not in self.defined and not _is_ours(word)]
        first = words.index("-o")
        started = sorted({program for part in needed for program in self.programs[part]})
        return Part((*needed, *started), (*words[:first], *needed, *words[first:]), file)


def read_objects(build, program):
    """The object files of a program that is built, such as "tests/test_cuda"; None where the program is not made of such."""
    inputs = _inputs(build, program)
    command = shlex.split(_ask(build, "ninja", "-t", "commands", program).strip().splitlines()[-1])
    words = command[2:-2] if command[:2] == [":", "&&"] and command[-2:] == ["&&", ":"] else []
    own = [name for kind, name in inputs if kind == "" and name.endswith(".o")]
    if "-o" not in words or "&&" in words or not own:
        return None
    libraries = dict.fromkeys(name for kind, name in inputs if kind == "|" and _is_ours(name))
    files = own + [name for library in libraries for kind, name in _inputs(build, library) if kind == "" and name.endswith(".o")]
    defined, weak, used, bodies = ({file: set() for file in files} for _ in range(4))
    for line in _ask(build, "nm", "--format=posix", "--print-file-name", *files).splitlines():
        file, _, rest = line.partition(": ")
        symbol, kind = rest.split()[:2]
        if found := TEST_BODY.search(symbol):
            bodies[file].add(found[1])
        if kind == "U":
            used[file].add(symbol)
        elif kind in "WVu":
            weak[file].add(symbol)
        elif kind.isupper():
            defined[file].add(symbol)
    started = [name for kind, name in inputs if kind == "||" and (build / name).is_file() and not name.endswith((".a", ".o", ".so"))]
    programs = {file: _named(build, file, started) for file in files}
    return Objects(own, defined, weak, used, bodies, programs, words)


def _named(build, file, programs):
    """The programs whose paths stand in an object file: its tests may start them."""
    content = (build / file).read_bytes()
    return {program for program in programs if str(build / program).encode() in content}


def _is_body_of(test, body):
    """Whether `body` (such as "..16RadixTree_Of_Test") is that of a test ("RadixTree.Of", "Sizes/RadixTree.Of/3", "RadixTree/0.Of")."""
    texts = [f"{name.replace('.', '_')}_Test" for name in gtest.in_the_code(test)]
    return any(body.endswith(f"{len(text)}{text}") for text in texts)


def _is_ours(name):
    return name.endswith(".a") and not name.startswith("/")


def _inputs(build, target):
    """[(kind, name)] of what a target is made of. Kind: "" (named in the command), "|" (others) or "||" (built before it)."""
    found, reading = [], False
    for line in _ask(build, "ninja", "-t", "query", target).splitlines():
        if line.startswith("  ") and not line.startswith("    "):
            reading = line.strip().startswith("input:")
        elif reading:
            kind, _, name = line.strip().rpartition(" ")
            found.append((kind, name))
    return found


def _ask(folder, *command):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout
