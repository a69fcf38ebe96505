"""The quick check of tests/mutants/patches/, for ./run test: every head is complete, every patch applies to the sources, and
every test and target that it names is there, and those of first_tests.txt. Prints what is wrong, and exits with 1 if anything is.

check_patches.py [ROOT]
"""

import functools
import os
import pathlib
import re
import subprocess
import sys

import gtest
import judged
import mutant
from project import is_test_program
from sources import apply

TESTS = re.compile(r"\b(TEST|TEST_P|TEST_F|TYPED_TEST|TYPED_TEST_P|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\(\s*(\w+),\s*(\w+)")
TARGETS = re.compile(r"\b(plumbline_test_folder|add_executable)\(\s*([\w/]+)")


def readable(folder):
    """The mutants of a folder, and sentences about the files that are none."""
    found, faults = [], []
    for path in sorted(folder.iterdir()):
        if not re.fullmatch(r"[a-z0-9_]+\.patch", path.name):
            faults.append(f"{path.name}: a mutant's file is lower_case_words.patch")
            continue
        try:
            found.append(mutant.parse(path.stem, path.read_text()))
        except ValueError as error:
            faults.append(str(error))
    return found, faults


def defined_tests(root):
    """"Suite.Name" of all tests in C++, without parameters."""
    texts = (path.read_text() for path in sorted((root / "tests").rglob("*_test.cpp")))
    return {f"{suite}.{name}" for text in texts for _, suite, name in TESTS.findall(text)}


def defined_targets(root):
    """The programs that the CMake files make."""
    found = set()
    for path in [root / "CMakeLists.txt", *root.glob("cli/CMakeLists.txt"), *(root / "tests").rglob("CMakeLists.txt")]:
        for command, name in TARGETS.findall(path.read_text()):
            found.add("test_" + name.replace("/", "_") if command == "plumbline_test_folder" else name)
    return found


@functools.cache
def exists(pattern, tests):
    """Whether a test has this name, with parameters: "Kinds/Emission.Works/sphere" is Emission.Works, and of typed tests
    "TypedTree/0.Works" is TypedTree.Works."""
    suite, dot, name = pattern.partition(".")
    return any(gtest.matching(part + dot + name.split("/")[0], tests) for part in suite.split("/"))


def do_not_apply(mutants, root):
    """Sentences about patches that do not apply. All are tried at once; one by one only if something is wrong."""
    files = [str(mutant.PATCHES / f"{made.name}.patch") for made in mutants]
    environment = dict(os.environ, GIT_CEILING_DIRECTORIES=str(root.resolve().parent))
    command = ["git", "-c", "safe.directory=*", "apply", "--check", *files]
    if not files or subprocess.run(command, cwd=root, capture_output=True, env=environment).returncode == 0:
        return []
    complaints = ((made, apply(made.diff, root, "--check")) for made in mutants)
    return [f"{made.name}.patch does not apply: {text.splitlines()[0]}" for made, text in complaints if text]


def lost_tags(diff):
    """The tags of docs/map.md that a change removes. Without some of them explain/ cannot be configured."""
    tags = [re.findall(rf"^{re.escape(sign)}.*// map: (.*)", diff, re.MULTILINE) for sign in "-+"]
    return [tag for tag in tags[0] if tag not in tags[1]]


def faults_of(made, tests, targets):
    yield from (f"{made.name}.patch: the tag // map: {tag} must stay" for tag in lost_tags(made.diff))
    yield from (f"{made.name}.patch: there is no program {name}" for name in made.programs if name not in targets)
    if not any(map(is_test_program, made.programs)):
        return
    for pattern in (*made.fails, *made.passes):
        if not exists(pattern, tests):
            yield f"{made.name}.patch: there is no test {pattern}"


def first_tests_that_are_none(root, tests):
    """Sentences about the list of tests with which ctest begins."""
    names = (root / "tests/mutants/first_tests.txt").read_text().splitlines()
    return [f"first_tests.txt: there is no test {name}" for name in names if not exists(name, tests)]


def idle_tests_that_are_none(root, tests):
    """Sentences about idle.toml, which names tests that notice no mutant."""
    file = root / "tests/mutants/idle.toml"
    return [f"idle.toml: there is no test {pattern}" for pattern in judged.reasons(file) if not exists(pattern, tests)]


def main(root=mutant.ROOT):
    mutants, faults = readable(mutant.PATCHES)
    tests, targets = frozenset(defined_tests(root)), defined_targets(root)
    faults += do_not_apply(mutants, root)
    faults += [fault for made in mutants for fault in faults_of(made, tests, targets)]
    diffs = {}
    for made in mutants:
        if (first := diffs.setdefault(made.diff, made.name)) != made.name:
            faults.append(f"{made.name}.patch: the same change as {first}.patch")
    faults = [f"patches/{fault}" for fault in faults] + first_tests_that_are_none(root, tests)
    faults += idle_tests_that_are_none(root, tests)
    for fault in faults:
        print(f"tests/mutants/{fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*map(pathlib.Path, sys.argv[1:2])))
