"""Runs the exercises of docs/exercises.md: ./run exercises [NAME...]

An exercise is a patch, NAME.patch beside this file, with a head of lines "Key: value":

    Removed: what the patch takes away or makes wrong
    Program: the test program, a CMake target
    Fails:   tests that must fail with the patch
    Passes:  tests that must pass in spite of it (may be absent)
    Sanitizer: (may be absent) the one that Fails needs; Passes are run without it

Tests are separated by commas; for a program that is no test program, they are its arguments. Each exercise works on a copy
of the sources in build/exercises. First all named tests must pass on the sources as they are. Then each patch is applied, its
program is built again, and its tests are run one by one. The exit status is 1 if a claim is wrong.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
SOURCES = ROOT / "build" / "exercises"
PRESETS = {"": "release", "thread": "tsan"}  # by sanitizer
SECONDS_PER_TEST = 180  # the longest takes some seconds; what is removed may make a loop endless


class Exercise:
    def __init__(self, path):
        self.name = path.stem
        self.path = path
        head, _, self.diff = path.read_text().partition("\n\n")
        keys = dict(line.split(": ", 1) for line in head.splitlines())
        self.removed = keys.pop("Removed")
        self.program = keys.pop("Program")
        self.fails = keys.pop("Fails").split(", ")
        self.passes = keys.pop("Passes", "").split(", ") if "Passes" in keys else []
        self.sanitizer = keys.pop("Sanitizer", "")
        if keys:
            raise ValueError(f"{path.name}: unknown keys {sorted(keys)}")

    def files(self):
        return re.findall(r"^\+\+\+ b/(\S+)", self.diff, re.MULTILINE)

    def runs(self):
        """(sanitizer, test, whether it must pass) for all tests."""
        return [(self.sanitizer, test, False) for test in self.fails] + [("", test, True) for test in self.passes]


def exercises(names=()):
    """Those of the given names, in this order, or all. Raises KeyError for an unknown name."""
    known = {path.stem: path for path in sorted(FOLDER.glob("*.patch"))}
    return [Exercise(known[name]) for name in (names or known)]


def copy_sources():
    """Brings the copy up to date; files that did not change keep their time, so that nothing is built twice."""
    listed = run(["git", "ls-files", "-z"], cwd=ROOT)
    if listed.returncode != 0:
        raise RuntimeError(f"git cannot list the sources: {listed.stderr.strip()}")
    for name in filter(None, listed.stdout.split("\0")):
        source, target = ROOT / name, SOURCES / name
        if not source.is_file() or (target.is_file() and target.read_bytes() == source.read_bytes()):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target)  # the time is now: a file that was restored is built again


def run(command, **options):
    return subprocess.run(command, capture_output=True, text=True, **options)


def build(program, sanitizer, jobs):
    """Builds a program of the copy. Returns its path; raises RuntimeError with the compiler's words."""
    folder = SOURCES / "build" / PRESETS[sanitizer]
    configure = ["cmake", "--preset", PRESETS[sanitizer], "-DPLUMBLINE_CUDA=OFF"]
    compile_program = ["cmake", "--build", str(folder), "--target", program, "-j", str(jobs)]
    environment = dict(os.environ, CCACHE_BASEDIR=str(SOURCES))
    # Once there are build rules, ninja configures again by itself when it must.
    for command in [compile_program] if (folder / "build.ninja").is_file() else [configure, compile_program]:
        result = run(command, env=environment, cwd=SOURCES)
        if result.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}\n{result.stdout[-3000:]}{result.stderr[-3000:]}")
    return next(path for path in (folder / "tests").rglob(program) if path.is_file())


def passes(program, test):
    """Whether a test passes. A crash and an endless loop are failures."""
    # Properties draw the same inputs in every run.
    environment = dict(os.environ, RC_PARAMS="seed=1")
    arguments = [f"--gtest_filter={test}"] if program.name.startswith("test_") else test.split()
    try:
        result = run([str(program), *arguments], env=environment, timeout=SECONDS_PER_TEST)
    except subprocess.TimeoutExpired:
        return False
    if program.name.startswith("test_") and "Running 0 tests" in result.stdout:
        raise RuntimeError(f"{program.name} has no test {test}")
    return result.returncode == 0


def results(exercise, jobs):
    """Whether each test of the exercise passes, in the order of runs()."""
    programs = {}
    for sanitizer, _, _ in exercise.runs():
        if sanitizer not in programs:
            programs[sanitizer] = build(exercise.program, sanitizer, jobs)
    return [passes(programs[sanitizer], test) for sanitizer, test, _ in exercise.runs()]


def fail_unchanged(chosen, jobs):
    """Sentences about the tests of these exercises that fail without a patch."""
    copy_sources()
    return [
        f"{test} of {exercise.name} fails without the patch"
        for exercise in chosen
        for (_, test, _), passed in zip(exercise.runs(), results(exercise, jobs))
        if not passed
    ]


def wrong_claims(exercise, jobs):
    """Runs the exercise. Returns sentences about claims that are not true."""
    copy_sources()
    # From the root: in a folder of a working tree, git ignores a patch of files that are not below it.
    copy = SOURCES.relative_to(ROOT)
    applied = run(["git", "apply", f"--directory={copy}", "-"], cwd=ROOT, input=exercise.diff)
    if applied.returncode != 0:
        return [applied.stderr.strip()]
    wrong = []
    try:
        for (_, test, expected), passed in zip(exercise.runs(), results(exercise, jobs)):
            print(f"  {'passes' if passed else 'fails '} {test}", flush=True)
            if passed != expected:
                wrong.append(f"{test} {'passes' if passed else 'fails'} with the patch")
    finally:
        copy_sources()
    return wrong


def main():
    parser = argparse.ArgumentParser(
        prog="./run exercises", description="Removes one thing from a copy of the sources, and looks which tests fail."
    )
    parser.add_argument("name", nargs="*", help="an exercise of docs/exercises.md; default: all")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count(), help="compilers at once")
    arguments = parser.parse_args()
    try:
        chosen = exercises(arguments.name)
    except KeyError as error:
        parser.error(f"there is no exercise {error}")
    print("First the tests of all of them, with nothing removed", flush=True)
    for sentence in (unchanged := fail_unchanged(chosen, arguments.jobs)):
        print(f"  WRONG: {sentence}", flush=True)
    failed = []
    for i, exercise in enumerate(chosen, 1):
        print(f"{i} of {len(chosen)}, {exercise.name}: without {exercise.removed}", flush=True)
        wrong = wrong_claims(exercise, arguments.jobs)
        for sentence in wrong:
            print(f"  WRONG: {sentence}", flush=True)
        failed += [exercise.name] if wrong else []
    if failed:
        print("Claims that are not true: " + ", ".join(failed))
    return 1 if failed or unchanged else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except RuntimeError as error:
        sys.exit(f"exercises: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
