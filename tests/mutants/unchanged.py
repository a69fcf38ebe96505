"""The sources without a mutant: every test that is used must pass, and how long it takes decides when it is run.

What was measured is kept in measured.json, with the hash of each program's sources.
"""

import json
import threading

import gtest
from keep import write_whole
from project import arguments_of, is_test_program

FIRST_RUN_SECONDS = 3600


class Unusable(Exception):
    """A sentence that says why no table can be made."""


class Unchanged:
    """`times`: seconds of each test, by preset and program ("release/test_golden"). A program that is no test program has its
    arguments as tests."""

    def __init__(self, project, digests):
        self.project, self.digests = project, digests
        self.file = project.place / "measured.json"
        try:
            kept = json.loads(self.file.read_text())
        except (OSError, ValueError):
            kept = {}
        self._lock = threading.Lock()
        sources = kept.get("digests", {})  # earlier versions had another key
        self.times = {key: times for key, times in kept.get("times", {}).items() if sources.get(key) == self._sources(key)}

    def _sources(self, key):
        return self.digests.of_programs([key.split("/")[1]])

    @staticmethod
    def wanted(mutants):
        """(preset, program) of what these mutants need, with the tests: None stands for all."""
        wanted = {}
        for mutant in mutants:
            for program in mutant.programs:
                if is_test_program(program):
                    wanted["release", program] = None
                if mutant.preset != "release" or not is_test_program(program):  # slow, or no list: only what is needed
                    wanted.setdefault((mutant.preset, program), []).extend(mutant.fails)
        return wanted

    def missing(self, mutants):
        """What of this must still be measured."""
        return {key: tests for key, tests in self.wanted(mutants).items() if self._lacks(key, tests)}

    def _lacks(self, key, tests):
        known = self.times.get("/".join(key))
        if known is None or tests is None:
            return known is None
        is_known = gtest.matching if is_test_program(key[1]) else lambda test, names: test in names
        return any(not is_known(test, known) for test in tests)

    def build(self, copy, preset, program):
        """Builds a program of a copy that is up to date. Raises Unusable if that fails."""
        if error := self.project.build_unchanged(copy.folder, preset, program):
            raise Unusable(f"{program} does not build without a mutant:\n{error}")

    def measure(self, copy, preset, program, tests):
        """Runs a program that is built. Raises Unusable if a test does not pass."""
        if is_test_program(program):
            found = self._tests(copy, preset, program, tests)
        else:
            found = {test: self._run(copy, preset, program, [test]).seconds for test in dict.fromkeys(tests)}
        with self._lock:
            self.times.setdefault(f"{preset}/{program}", {}).update(found)
            sources = {key: self._sources(key) for key in self.times}
            write_whole(self.file, json.dumps({"digests": sources, "times": self.times}, indent=1))

    def _tests(self, copy, preset, program, tests):
        objects = self.project.objects(copy.folder, preset, program)
        if tests is not None or objects is None:
            return self._passed(copy, preset, program, tests)
        # In the parts in which they are run with a mutant: what a part lacks must not be taken for a mistake.
        found = {}
        for file in objects.with_tests():
            part = objects.part([file], f"{program}_part")
            if not self.project.link_part(copy.folder, preset, part):
                raise Unusable(f"{program} ({preset}): its part with {file} cannot be linked")
            found.update(self._passed(copy, preset, program, None, f"{program}_part"))
        return found

    def _passed(self, copy, preset, program, tests, started=None):
        """Seconds by test of those that pass; all must. `started`: the part of the program that is run."""
        ended = self._run(copy, preset, started or program, list(dict.fromkeys(tests)) if tests else ["*"])
        output = gtest.read_output(ended.output)
        if output.failed or output.unfinished or not output.complete or output.racy:
            names = ", ".join(output.failed) or output.unfinished or output.racy or "its end"
            raise Unusable(f"{program} ({preset}) fails without a mutant, in {names}")
        for test in tests or []:
            if not gtest.matching(test, output.passed):
                raise Unusable(f"{program} ({preset}) has no test {test} that is run here")
        return output.passed

    def _run(self, copy, preset, program, tests):
        ended = self.project.run(copy.folder, preset, program, arguments_of(program, tests), FIRST_RUN_SECONDS)
        if ended.status is None:
            raise Unusable(f"{program} ({preset}) did not end without a mutant, in {FIRST_RUN_SECONDS} seconds")
        if ended.status != 0 and not gtest.read_output(ended.output).failed:
            last = (ended.output.strip().splitlines() or ["no output"])[-1]
            raise Unusable(f"{program} ({preset}) ends with status {ended.status} without a mutant: {last[:300]}")
        return ended
