"""The cheap half of the check of docs/exercises.md; ./run exercises does the other half.

Every patch of tests/exercises/ applies to the sources, every test that it names exists, and the page has each exercise,
with all of these tests in its answer. exercise_page.py prints what is wrong, and exits with 1 if anything is.
"""

import re
import subprocess
import sys

from source_text import ROOT

sys.path.insert(0, str(ROOT / "tests" / "exercises"))
from exercises import exercises  # noqa: E402

PAGE = "docs/exercises.md"
FEWEST = 12
DETAILS = "<details markdown='1'>"  # MkDocs needs the attribute


def test_name(full):
    """Suite and name of a gtest without the parameters: of "Kinds/Emission.Works/sphere", Emission and Works."""
    suite, name = full.split(".")
    return suite.split("/")[-1], name.split("/")[0]


def is_defined(test, sources):
    suite, name = test_name(test)
    return any(re.search(rf"\b(TEST|TEST_P|TEST_F|RC_GTEST_PROP)\({suite},\s*{name}\b", text) for text in sources)


def sections(page):
    """The text of each exercise by its name, which stands behind the title as code."""
    found = {}
    for section in re.split(r"^### ", page, flags=re.MULTILINE)[1:]:
        name = re.match(r"[^\n]*`([a-z_]+)`\n", section)
        found[name[1] if name else section.splitlines()[0]] = section
    return found


def faults_of(exercise, section, sources):
    applied = subprocess.run(["git", "apply", "--check", "-"], cwd=ROOT, input=exercise.diff, text=True, capture_output=True)
    if applied.returncode != 0:
        yield f"{exercise.name}.patch does not apply: {applied.stderr.strip()}"
    if section is None:
        yield f"has no exercise {exercise.name}"
        return
    question, _, answer = section.partition(DETAILS)
    if not answer or "</details>" not in answer:
        yield f"{exercise.name} has no answer in {DETAILS}"
    yield from (f"{exercise.name}: the question does not name {file}" for file in exercise.files() if file not in question)
    for _, test, _ in exercise.runs():
        if not exercise.program.startswith("test_"):
            if exercise.program not in answer:
                yield f"{exercise.name}: the answer does not name {exercise.program}"
        elif not is_defined(test, sources):
            yield f"{exercise.name}: there is no test {test}"
        elif test_name(test)[1] not in answer:
            yield f"{exercise.name}: the answer does not name {test_name(test)[1]}"


def main():
    page = sections((ROOT / PAGE).read_text())
    all_exercises = exercises()
    sources = [path.read_text() for path in (ROOT / "tests").rglob("*_test.cpp")]
    faults = [fault for exercise in all_exercises for fault in faults_of(exercise, page.get(exercise.name), sources)]
    faults += [f"{name}: there is no such patch" for name in page if name not in {e.name for e in all_exercises}]
    if len(all_exercises) < FEWEST:
        faults.append(f"there are only {len(all_exercises)} exercises")
    for fault in faults:
        print(f"{PAGE}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
