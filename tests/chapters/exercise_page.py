"""The cheap half of the check of docs/exercises.md; ./run exercises does the other half.

The page has each exercise, with all of its tests in the answer. That the patches apply and that these tests exist is checked
for all mutants (tests/mutants/check_patches.py). exercise_page.py prints what is wrong, and exits with 1 if anything is.
"""

import re
import sys

from source_text import ROOT

sys.path.insert(0, str(ROOT / "tests" / "mutants"))
from exercises import exercises, runs  # noqa: E402
from project import is_test_program  # noqa: E402

PAGE = "docs/exercises.md"
FEWEST = 12
DETAILS = "<details markdown='1'>"  # MkDocs needs the attribute


def sections(page):
    """The text of each exercise by its name, which stands behind the title as code."""
    found = {}
    for section in re.split(r"^### ", page, flags=re.MULTILINE)[1:]:
        name = re.match(r"[^\n]*`([a-z_]+)`\n", section)
        found[name[1] if name else section.splitlines()[0]] = section
    return found


def bare_name(test):
    """The name of a gtest without suite and parameters: of "Kinds/Emission.Works/sphere", Works."""
    return test.split(".")[1].split("/")[0]


def faults_of(exercise, section):
    if section is None:
        yield f"has no exercise {exercise.name}"
        return
    question, _, answer = section.partition(DETAILS)
    if not answer or "</details>" not in answer:
        yield f"{exercise.name} has no answer in {DETAILS}"
    yield from (f"{exercise.name}: the question does not name {file}" for file in exercise.files if file not in question)
    program = exercise.programs[0]
    for _, test, _ in runs(exercise):
        name = bare_name(test) if is_test_program(program) else program
        if name not in answer:
            yield f"{exercise.name}: the answer does not name {name}"


def main():
    page = sections((ROOT / PAGE).read_text())
    all_exercises = exercises()
    faults = [fault for exercise in all_exercises for fault in faults_of(exercise, page.get(exercise.name))]
    faults += [f"{name}: there is no such patch" for name in page if name not in {e.name for e in all_exercises}]
    if len(all_exercises) < FEWEST:
        faults.append(f"there are only {len(all_exercises)} exercises")
    for fault in faults:
        print(f"{PAGE}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
