"""What a GoogleTest program prints, and the tests that it is asked to run."""

import fnmatch
import re
from typing import NamedTuple

LINE = re.compile(r"\[ +(RUN|OK|FAILED|SKIPPED) +\] ([^\s,]+)(?:, where .*?)?(?: \((\d+) ms\))?$", re.MULTILINE)
MOST_IN_A_GROUP = 300  # an argument has at most 128 KiB


class Output(NamedTuple):
    """`passed`: seconds of each test that passed. `failed`: tests that failed. `unfinished`: the test that did not come to its
    end. `complete`: whether the program ran to its end. `racy`: the first test in which ThreadSanitizer saw a race."""

    passed: dict[str, float]
    failed: list[str]
    unfinished: str
    complete: bool
    racy: str


def read_output(text):
    passed, failed, unfinished = {}, [], ""
    for what, name, milliseconds in LINE.findall(text):
        if what == "RUN":
            unfinished = name
        elif milliseconds:  # without, it is a line of the summary
            unfinished = ""
            if what == "OK":
                passed[name] = int(milliseconds) / 1000
            elif what == "FAILED":
                failed.append(name)
    complete = not unfinished and re.search(r"\[==========\] \d+ tests? from .* ran\.", text) is not None
    return Output(passed, failed, unfinished, complete, _racy(text))


def _racy(text):
    before, warning, _ = text.partition("WARNING: ThreadSanitizer")
    names = re.findall(r"\[ RUN      \] (\S+)", before) if warning else []
    return names[-1] if names else ""


def matching(pattern, names):
    """The tests that a pattern of --gtest_filter names ("*" and "?" are wildcards)."""
    escaped = pattern.replace("[", "[[]")
    return [name for name in names if fnmatch.fnmatchcase(name, escaped)]


def in_the_code(test):
    """What a test ("All/Suite.Name/3", "Suite/0.Name") may be called in the code: Suite.Name for each part of the suite's name."""
    suite, _, name = test.partition(".")
    return [f"{part}.{name.partition('/')[0]}" for part in suite.split("/")]


def filter_argument(names):
    return "--gtest_filter=" + ":".join(names)


def groups(times):
    """Tests in the order of their time, in groups: the first takes about 0.2 s, each one twice as long as the one before."""
    found, limit = [[]], 0.2
    for name in sorted(times, key=lambda name: (times[name], name)):
        group = found[-1]
        if group and (sum(times[n] for n in group) + times[name] > limit or len(group) >= MOST_IN_A_GROUP):
            limit = min(2 * limit, 60)
            found.append([])
        found[-1].append(name)
    return [group for group in found if group]
