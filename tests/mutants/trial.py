"""One mutant in one copy: apply it, build what sees it, run tests until one fails, take it back."""

import time

import gtest
from keep import Outcome, Result
from project import arguments_of, is_test_program, most_seconds

MOST_TIMEOUTS, MOST_CRASHES = 3, 20  # with all tests: a mutant that hangs in every test would take hours


class DoesNotBuild(Exception):
    """What the compiler said."""


def noticed(project, folder, preset, program, tests, seconds, fail_fast=False):
    """Runs tests of a program that is built. Returns [(test, Outcome)] of those that do not pass, the tests that passed, and
    the seconds that it took."""
    arguments = arguments_of(program, tests) + (["--gtest_fail_fast"] if fail_fast and is_test_program(program) else [])
    ended = project.run(folder, preset, program, arguments, seconds)
    if not is_test_program(program):
        name = f"{program} {tests[0]}"
        if ended.status == 0:
            return [], [tests[0]], ended.seconds
        return [(name, _how_it_ended(ended.status))], [], ended.seconds
    output = gtest.read_output(ended.output)
    found = [(name, Outcome.KILLED) for name in output.failed]
    if output.racy and ended.status not in (0, None):
        found.append((output.racy, Outcome.KILLED))
    elif ended.status is None or not output.complete or (ended.status != 0 and not found):
        found.append((output.unfinished or f"{program}, outside of its tests", _how_it_ended(ended.status, Outcome.CRASH)))
    return found, list(output.passed), ended.seconds


def _how_it_ended(status, otherwise=Outcome.KILLED):
    if status is None:
        return Outcome.TIMEOUT
    return Outcome.CRASH if status < 0 else otherwise


def try_mutant(project, copy, times, mutant, all_tests=False):
    """What becomes of the mutant. `copy` is up to date before and after. `times`: see Unchanged."""
    files = mutant.files or [""]
    result = Result(mutant.name, files[0], mutant.title, Outcome.NO_PATCH, equivalent=mutant.equivalent, all_tests=all_tests)
    take_back = copy.change(mutant)
    if isinstance(take_back, str):
        result.detail = take_back
        return result
    try:
        trial = _Trial(project, copy.folder, times, mutant, result)
        try:
            trial.run_all() if all_tests else trial.run_until_noticed()
        except DoesNotBuild as error:
            # Tests of another program may have noticed it before: even so, this is no mutant.
            result.outcome, result.killed_by, result.killers, result.detail = Outcome.NO_BUILD, "", [], str(error)
    finally:
        take_back()
    return result


class _Trial:
    def __init__(self, project, folder, times, mutant, result):
        self.project, self.folder, self.times = project, folder, times
        self.mutant, self.result = mutant, result
        self.built, self.passed, self.ends = set(), [], {}
        self.result.outcome = Outcome.SURVIVED

    def claims(self):
        """(seconds, preset, program, tests, pattern) of what Fails names, the cheapest first."""
        found = []
        for pattern in self.mutant.fails:
            for program in self.mutant.programs:
                preset = self.mutant.preset
                known = self.times.get(f"{preset}/{program}", {})
                tests = gtest.matching(pattern, known) if is_test_program(program) else [pattern] * (pattern in known)
                if tests:
                    found.append((sum(known[test] for test in tests), preset, program, tests, pattern))
                    break
            else:
                self.result.wrong.append(f"no program has a test {pattern} that passes without the mutant")
        return sorted(found)

    def run_until_noticed(self):
        tried = set()
        for seconds, preset, program, tests, _ in self.claims():
            if self._run(preset, program, tests, seconds, fail_fast=True):
                return
            tried.update((preset, program, test) for test in tests)
        for program in self.mutant.programs:
            times = self.times.get(f"release/{program}", {}) if is_test_program(program) else {}
            rest = {test: time for test, time in times.items() if ("release", program, test) not in tried}
            for group in gtest.groups(rest):
                if self._run("release", program, group, sum(rest[test] for test in group), fail_fast=True):
                    if self.mutant.fails:
                        self.result.wrong.append("no test that Fails names noticed it: " + ", ".join(self.mutant.fails))
                    return

    def run_all(self):
        for seconds, preset, program, tests, _ in self.claims():
            if preset != "release" or not is_test_program(program):
                self._run(preset, program, tests, seconds)
        for program in filter(is_test_program, self.mutant.programs):
            times = self.times.get(f"release/{program}", {})
            for group in gtest.groups(times):
                self._run_whole_group(program, {test: times[test] for test in group})
        for pattern in self.mutant.fails:
            names = [pattern, *(f"{program} {pattern}" for program in self.mutant.programs)]
            if not any(gtest.matching(name, self.result.killers) for name in names):
                self.result.wrong.append(f"{pattern} passes with the mutant")
        for pattern in self.mutant.passes:
            if failing := gtest.matching(pattern, self.result.killers):
                self.result.wrong.append(f"{failing[0]} fails with the mutant")

    def _run_whole_group(self, program, times):
        """Where a test ends the program, those after it are run again."""
        while times:
            outcomes = self._run("release", program, list(times), sum(times.values()))
            last = outcomes[-1] if outcomes else ("", Outcome.KILLED)
            if last[1] is Outcome.KILLED or last[0] not in times or self._ended_too_often(last[1]):
                return
            done = {name for name, _ in outcomes} | set(self.passed)
            times = {test: time for test, time in times.items() if test not in done}

    def _ended_too_often(self, outcome):
        count = self.ends[outcome] = self.ends.get(outcome, 0) + 1
        return count >= (MOST_TIMEOUTS if outcome is Outcome.TIMEOUT else MOST_CRASHES)

    def _run(self, preset, program, tests, seconds, fail_fast=False):
        """Runs tests, and notes in the result which of them do not pass. Returns these."""
        self._build(preset, program)
        outcomes, self.passed, taken = noticed(
            self.project, self.folder, preset, program, tests, most_seconds(seconds), fail_fast
        )
        self.result.test_seconds += taken
        for name, outcome in outcomes:
            if not self.result.killed_by:
                self.result.killed_by, self.result.outcome = name, outcome
            if name not in self.result.killers:
                self.result.killers.append(name)
        return outcomes

    def _build(self, preset, program):
        if (preset, program) in self.built:
            return
        begin = time.monotonic()
        error = self.project.build(self.folder, preset, program)
        self.result.build_seconds += time.monotonic() - begin
        self.built.add((preset, program))
        if error:
            raise DoesNotBuild(error)
