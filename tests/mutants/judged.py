"""What was looked at by hand. Of generated mutants, judged.toml has a table for each:

    [NAME]
    equivalent = "why no test can tell the program with the mutant from the program without it"

What a test could tell is not judged: the test is written. Of tests that notice no mutant, idle.toml has the reason to exist:

    [[tests]]
    names = ["Suite.Name", "Other.*"]      # as in the code, without the prefix and the parameter of an instance
    reason = "what they see that no mutant is about"
"""

import functools
import pathlib

import gtest

FILE = pathlib.Path(__file__).with_name("judged.toml")
IDLE = pathlib.Path(__file__).with_name("idle.toml")


def entries(file):
    import tomllib  # of Python 3.11: to list mutants without judging needs none

    return tomllib.loads(file.read_text())


@functools.cache
def equivalent(file=FILE):
    """The names of the mutants that no test can see, each with the reason."""
    return {name: entry["equivalent"] for name, entry in entries(file).items()}


@functools.cache
def reasons(file=IDLE):
    """The reason to exist of tests that notice no mutant, by pattern."""
    return {name: group["reason"] for group in entries(file).get("tests", []) for name in group["names"]}


def reason_of(test, known):
    """The reason of `known` (reasons) for a test ("All/Suite.Name/3"); nothing if there is none."""
    names = gtest.in_the_code(test)
    return next((reason for pattern, reason in known.items() if gtest.matching(pattern, names)), "")


def faults(names, file=FILE):
    """Sentences about entries that are wrong. `names`: of all mutants that the generator makes."""
    found = []
    for name, entry in entries(file).items():
        if name not in names:
            found.append(f"{file.name}: there is no mutant {name}: its line has changed. Judge it again, or remove the entry.")
        if not isinstance(entry, dict) or list(entry) != ["equivalent"] or not str(entry["equivalent"]).strip():
            found.append(f"{file.name}: {name} needs one key, equivalent, with the reason")
    return found
