"""Runs the exercises of docs/exercises.md: ./run exercises [NAME...]

An exercise is a mutant whose head says what it removes. All tests that the head names are run: first on the sources as they
are, where each must pass; then with the patch, where each of Fails must fail and each of Passes must pass.
"""

import argparse
import sys

import mutant
from keep import alone
from machine import processors
from mutants import found, guarded
from project import Project, is_test_program
from trial import noticed

SECONDS_PER_TEST = 180  # the longest takes some seconds; what is removed may make a loop endless


def exercises(names=()):
    """Those of the given names, in this order, or all. Raises KeyError for an unknown name."""
    known = {made.name: made for made in mutant.kept() if made.removed}
    return [known[name] for name in (names or known)]


def runs(exercise):
    """(preset, test, whether it must pass with the patch) of each test of an exercise."""
    return [(exercise.preset, test, False) for test in exercise.fails] + [("release", test, True) for test in exercise.passes]


def passes(project, copy, preset, program, test):
    """Whether a test passes. A crash and an endless loop are failures. Raises RuntimeError if there is no such test."""
    if error := project.build(copy.folder, preset, program):
        raise RuntimeError(f"{program} does not build:\n{error}")
    failed, passed, _ = noticed(project, copy.folder, preset, program, [test], SECONDS_PER_TEST)
    if not failed and not passed and is_test_program(program):
        raise RuntimeError(f"{program} has no test {test}")
    return not failed


def fail_unchanged(project, copy, chosen):
    """Sentences about the tests of these exercises that fail without a patch."""
    claims = [(exercise, preset, test) for exercise in chosen for preset, test, _ in runs(exercise)]
    return [
        f"{test} of {exercise.name} fails without the patch"
        for exercise, preset, test in claims
        if not passes(project, copy, preset, exercise.programs[0], test)
    ]


def wrong_claims(project, copy, exercise):
    """Runs an exercise in a copy that is up to date. Returns sentences about claims that are not true."""
    take_back = copy.change(exercise)
    if isinstance(take_back, str):
        return [take_back]
    wrong = []
    try:
        for preset, test, expected in runs(exercise):
            passed = passes(project, copy, preset, exercise.programs[0], test)
            print(f"  {'passes' if passed else 'fails '} {test}", flush=True)
            if passed != expected:
                wrong.append(f"{test} {'passes' if passed else 'fails'} with the patch")
    finally:
        take_back()
    return wrong


def main(argv):
    parser = argparse.ArgumentParser(
        prog="./run exercises", description="Removes one thing from a copy of the sources, and looks which tests fail."
    )
    parser.add_argument("name", nargs="*", help="an exercise of docs/exercises.md; default: all")
    parser.add_argument("-j", "--jobs", type=int, default=processors(), help="compilers at once")
    arguments = parser.parse_args(argv)
    chosen = found("exercise", exercises, arguments.name, parser.error)
    project = Project(builders=arguments.jobs)
    with alone(project.place):
        return run_all(project, chosen)


def run_all(project, chosen):
    """The exit status: 1 if a claim is not true."""
    copy = project.copy(0)
    copy.bring_up_to_date()
    print("First the tests of all of them, with nothing removed", flush=True)
    for sentence in (unchanged := fail_unchanged(project, copy, chosen)):
        print(f"  WRONG: {sentence}", flush=True)
    failed = []
    for i, exercise in enumerate(chosen, 1):
        print(f"{i} of {len(chosen)}, {exercise.name}: without {exercise.removed}", flush=True)
        wrong = wrong_claims(project, copy, exercise)
        for sentence in wrong:
            print(f"  WRONG: {sentence}", flush=True)
        failed += [exercise.name] if wrong else []
    if failed:
        print("Claims that are not true: " + ", ".join(failed))
    return 1 if failed or unchanged else 0


if __name__ == "__main__":
    sys.exit(guarded(main, "exercises"))
