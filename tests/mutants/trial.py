"""One mutant in one copy: apply it, build what sees it, run tests until one fails, take it back."""

import threading
import time

import gtest
from keep import Outcome, Result
from project import arguments_of, is_test_program, most_seconds

ENOUGH = 2  # tests that notice a mutant: with two of them, it does not depend on one alone
MOST_TIMEOUTS, MOST_CRASHES = 3, 20  # of tests that have noticed nothing: a mutant that hangs in every test would take hours


class DoesNotBuild(Exception):
    """What the compiler said."""


class Idle:
    """The tests that have noticed no mutant so far: all but `busy` at the start."""

    def __init__(self, busy=()):
        self._busy, self._lock = set(busy), threading.Lock()

    def of(self, times):
        """Those of `times` (seconds by test)."""
        with self._lock:
            return {test: time for test, time in times.items() if test not in self._busy}

    def remove(self, tests):
        with self._lock:
            self._busy.update(tests)


def noticed(project, folder, preset, program, tests, seconds, fail_fast=False, started=None):
    """Runs tests of a program that is built. `started`: the part of it that holds them, or the program itself. Returns
    [(test, Outcome)] of those that do not pass, the tests that passed, and the seconds that it took."""
    arguments = arguments_of(program, tests) + (["--gtest_fail_fast"] if fail_fast and is_test_program(program) else [])
    ended = project.run(folder, preset, started or program, arguments, seconds)
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


def try_mutant(project, copy, times, mutant, idle=None):
    """What becomes of the mutant. `copy` is up to date before and after. `times`: see Unchanged. With `idle`, the tests are
    weighed (weigh_tests)."""
    files = mutant.files or [""]
    result = Result(mutant.name, files[0], mutant.title, Outcome.NO_PATCH, equivalent=mutant.equivalent, weighed=idle is not None)
    take_back = copy.change(mutant)
    if isinstance(take_back, str):
        result.detail = take_back
        return result
    try:
        trial = _Trial(project, copy.folder, times, mutant, result)
        try:
            trial.run_until_noticed() if idle is None else trial.weigh_tests(idle)
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
        self.built, self.part, self.tried, self.ends = set(), None, set(), {}
        self.result.outcome = Outcome.SURVIVED

    def claims(self, patterns):
        """What the mutant's head names, found as by _find, the cheapest first."""
        found = {pattern: self._find(pattern) for pattern in patterns}
        self.result.wrong += [f"no program has a test {name} that passes without the mutant" for name, claim in found.items() if not claim]
        return sorted(filter(None, found.values()))

    def _find(self, pattern):
        """(seconds, preset, program, tests, pattern) of the first program that has such tests; None if there is none."""
        preset = self.mutant.preset
        for program in self.mutant.programs:
            known = self.times.get(f"{preset}/{program}", {})
            tests = gtest.matching(pattern, known) if is_test_program(program) else [pattern] * (pattern in known)
            if tests:
                return sum(known[test] for test in tests), preset, program, tests, pattern
        return None

    def run_until_noticed(self):
        likely = sorted(filter(None, map(self._find, self.mutant.likely)))
        for seconds, preset, program, tests, _ in self.claims(self.mutant.fails) or likely:
            if self._run(preset, program, tests, seconds, fail_fast=True):
                return
        for program in filter(is_test_program, self.mutant.programs):
            rest = self._not_tried(program)
            for group in gtest.groups(rest):
                if self._run("release", program, group, sum(rest[test] for test in group), fail_fast=True):
                    if self.mutant.fails:
                        self.result.wrong.append("no test that Fails names noticed it: " + ", ".join(self.mutant.fails))
                    return

    def weigh_tests(self, idle):
        """Runs what the head names; then, of the tests in the same files, others until enough have noticed the mutant, and those
        in `idle`. If none of these notices it, all tests follow."""
        claims = self.claims((*self.mutant.fails, *self.mutant.passes))
        programs = {(preset, program) for _, preset, program, *_ in claims}
        for preset, program in programs:
            self._build(preset, program, [test for _, *of, tests, _ in claims if of == [preset, program] for test in tests])
        for seconds, preset, program, tests, _ in claims:
            self._run_whole_group(preset, program, dict.fromkeys(tests, seconds / len(tests)))
        for preset, program in programs:
            self._weigh_others(program, self._not_tried_in_the_files(preset, program), idle)
        if not self.result.killers:
            for program in filter(is_test_program, self.mutant.programs):
                self._weigh_others(program, self._not_tried(program), idle)
        idle.remove(self.result.killers)
        for pattern in self.mutant.fails:
            names = [pattern, *(f"{program} {pattern}" for program in self.mutant.programs)]
            if not any(gtest.matching(name, self.result.killers) for name in names):
                self.result.wrong.append(f"{pattern} passes with the mutant")
        for pattern in self.mutant.passes:
            if failing := gtest.matching(pattern, self.result.killers):
                self.result.wrong.append(f"{failing[0]} fails with the mutant")

    def _weigh_others(self, program, times, idle):
        for group in gtest.groups(times):
            if len(self.result.killers) < ENOUGH:
                self._run_whole_group("release", program, {test: times[test] for test in group})
        for group in gtest.groups(idle.of(self._without_tried(program, times))):
            self._run_whole_group("release", program, {test: times[test] for test in group})

    def _not_tried(self, program):
        return self._without_tried(program, self.times.get(f"release/{program}", {}))

    def _without_tried(self, program, times):
        return {test: time for test, time in times.items() if ("release", program, test) not in self.tried}

    def _not_tried_in_the_files(self, preset, program):
        """Those in the files of the part that is built; all where there are no parts."""
        rest = self._not_tried(program) if preset == "release" and is_test_program(program) else {}
        objects = self.project.objects(self.folder, preset, program)
        if objects is None or self.part is None:
            return rest
        return {test: time for test, time in rest.items() if self._covers(preset, program, objects.of_tests([test]))}

    def _covers(self, preset, program, files):
        """Whether the part that was built last holds the tests of these object files."""
        return self.part is not None and self.part[:2] == (preset, program) and set(files) <= set(self.part[2].targets)

    def _run_whole_group(self, preset, program, times):
        """Where a test ends the program, those after it are run again."""
        while times:
            outcomes = self._run(preset, program, list(times), sum(times.values()))
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
        started = self._build(preset, program, tests)
        outcomes, self.passed, taken = noticed(
            self.project, self.folder, preset, program, tests, most_seconds(seconds), fail_fast, started
        )
        self.tried.update((preset, program, test) for test in tests)
        self.result.test_seconds += taken
        for name, outcome in outcomes:
            if not self.result.killed_by:
                self.result.killed_by, self.result.outcome = name, outcome
                self.result.noticed_after = self.result.build_seconds + self.result.test_seconds
            if name not in self.result.killers:
                self.result.killers.append(name)
        return outcomes

    def _build(self, preset, program, tests):
        """Builds what holds the tests: a part of the program, or all of it. Returns the name of what is to be run."""
        if (preset, program) in self.built:
            return program
        begin = time.monotonic()
        try:
            return self._build_part(preset, program, tests) or self._build_whole(preset, program)
        finally:
            self.result.build_seconds += time.monotonic() - begin

    def _build_part(self, preset, program, tests):
        """The name of the part; nothing where the whole program has to be built."""
        objects, name = self.project.objects(self.folder, preset, program), f"{program}_part"
        files = objects and objects.of_tests(tests)
        if not files:
            return None
        if self._covers(preset, program, files):
            return name
        part = objects.part(files, name)
        if error := self.project.build_part(self.folder, preset, part):
            raise DoesNotBuild(error)
        if not self.project.link_part(self.folder, preset, part):
            return None
        self.part = (preset, program, part)
        return name

    def _build_whole(self, preset, program):
        error = self.project.build(self.folder, preset, program)
        self.built.add((preset, program))
        if error:
            raise DoesNotBuild(error)
        return program
