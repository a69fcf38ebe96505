"""The runner on a toy project: each outcome, wrong claims, a second start, and an end by Ctrl-C."""

import dataclasses
import io
import tempfile
import time
import unittest
from unittest import mock

import keep
import mutants
import trial
import workers
from keep import Outcome
from processes_test import ends_soon
from toy import Toy, toy_mutant
from unchanged import Unusable

MINUS = "echo $(($1 - $2))"
HANGS = "sleep 1000"
NOT_AN_ERROR = "echo $(($2 + $1))"


class Runner(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.project = Toy(temporary.name)
        limit = mock.patch.object(trial, "most_seconds", lambda measured: 3 if self.short else 60)
        limit.start()
        self.addCleanup(limit.stop)
        self.short = False
        self.said = io.StringIO()

    def run_mutants(self, *made, jobs=1, **options):
        results, _ = mutants.try_chosen(self.project, list(made), jobs, out=self.said, status=self.said, **options)
        for number in range(jobs):
            self.assert_restored(number)
        return results if len(results) > 1 else results[0]

    def assert_restored(self, number=0):
        sources, copy = ((folder / "ref/sum/sum.sh") for folder in (self.project.root, self.project.place / str(number)))
        if copy.exists():
            self.assertEqual(copy.read_text(), sources.read_text())


class Outcomes(Runner):
    def test_a_test_kills(self):
        result = self.run_mutants(toy_mutant("minus", MINUS, ["Sum.Adds"]))
        self.assertEqual((result.outcome, result.killed_by, result.wrong), (Outcome.KILLED, "Sum.Adds", []))
        self.assertTrue(result.fine)
        self.assertTrue(0 < result.noticed_after <= result.build_seconds + result.test_seconds)

    def test_without_a_change_all_tests_pass(self):
        result = self.run_mutants(toy_mutant("empty", "echo $(($1 + $2)) # nothing"))
        self.assertEqual((result.outcome, result.killed_by), (Outcome.SURVIVED, ""))
        self.assertFalse(result.fine)
        tried = {name for _, argument, *_ in self.project.ran[1:] for name in argument.partition("=")[2].split(":")}
        self.assertEqual(tried, {"Slow.Waits", "Sum.Adds", "Sum.TakesZero", "Sum.IsSmall"})

    def test_likely_tests_are_tried_first_and_may_pass_or_be_none(self):
        first = dataclasses.replace(toy_mutant("first", MINUS), likely=("Sum.None", "Sum.Adds"))
        result = self.run_mutants(first)
        self.assertEqual((result.outcome, result.killed_by, result.wrong), (Outcome.KILLED, "Sum.Adds", []))
        self.assertEqual(len(self.project.ran), 2)  # the first is that of the unchanged sources
        other = dataclasses.replace(toy_mutant("other", MINUS), likely=("Slow.Waits",))
        result = self.run_mutants(other)
        self.assertEqual((result.outcome, result.wrong), (Outcome.KILLED, []))

    def test_a_syntax_error_is_no_kill(self):
        result = self.run_mutants(toy_mutant("syntax", "echo $(($1 - $2)", ["Sum.Adds"]))
        self.assertEqual((result.outcome, result.killed_by), (Outcome.NO_BUILD, ""))
        self.assertIn("error", result.detail)
        self.assertFalse(result.fine)

    def test_a_patch_that_does_not_apply_is_no_kill(self):
        made = toy_mutant("stale", MINUS, ["Sum.Adds"])
        (self.project.root / "ref/sum/sum.sh").write_text("add() {\n    echo $(( $1 + $2 ))\n}\n")
        result = self.run_mutants(made)
        self.assertEqual((result.outcome, result.killed_by), (Outcome.NO_PATCH, ""))
        self.assertIn("sum.sh", result.detail)
        self.assertFalse(result.fine)

    def test_a_patch_that_changes_nothing(self):
        made = toy_mutant("same", MINUS)
        result = self.run_mutants(dataclasses.replace(made, diff=made.diff.replace("$1 - $2", "$1 + $2")))
        self.assertEqual((result.outcome, result.detail), (Outcome.NO_PATCH, "the patch changes nothing"))

    def test_a_hang_is_killed_by_time_out(self):
        self.short = True
        result = self.run_mutants(toy_mutant("hangs", HANGS, ["Sum.Adds"]))
        self.assertEqual((result.outcome, result.killed_by), (Outcome.TIMEOUT, "Sum.Adds"))
        self.assertTrue(result.fine)

    def test_a_crash(self):
        result = self.run_mutants(toy_mutant("crashes", "kill -SEGV $$", ["Sum.*"]))
        self.assertEqual((result.outcome, result.killed_by), (Outcome.CRASH, "Sum.Adds"))

    def test_an_end_before_the_last_test_is_a_crash(self):
        result = self.run_mutants(toy_mutant("ends", "kill -USR1 $$", ["Sum.Adds"]))  # with exit status 0
        self.assertEqual((result.outcome, result.killed_by), (Outcome.CRASH, "Sum.Adds"))

    def test_an_equivalent_mutant_may_survive_and_must(self):
        survives, killed = self.run_mutants(
            toy_mutant("survives", NOT_AN_ERROR, equivalent="a sum"), toy_mutant("killed", MINUS, equivalent="wrong")
        )
        self.assertEqual((survives.outcome, survives.fine), (Outcome.SURVIVED, True))
        self.assertEqual((killed.outcome, killed.fine), (Outcome.KILLED, False))


class Claims(Runner):
    def test_another_test_kills(self):
        result = self.run_mutants(toy_mutant("minus", MINUS, ["Sum.TakesZero"]))
        self.assertEqual((result.outcome, result.killed_by), (Outcome.KILLED, "Sum.Adds"))
        self.assertIn("no test that Fails names noticed it: Sum.TakesZero", result.wrong)
        self.assertFalse(result.fine)

    def test_a_test_that_is_not_there(self):
        result = self.run_mutants(toy_mutant("minus", MINUS, ["Sum.Multiplies", "Sum.Adds"]))
        self.assertEqual(result.outcome, Outcome.KILLED)
        self.assertIn("Sum.Multiplies", result.wrong[0])

    def test_weighed(self):
        result = self.run_mutants(toy_mutant("minus", MINUS, ["Sum.*", "Sum.IsSmall"], passes=["Slow.*"]), weigh=True)
        self.assertEqual(sorted(result.killers), ["Slow.Waits", "Sum.Adds"])
        self.assertEqual(result.wrong, ["Sum.IsSmall passes with the mutant", "Slow.Waits fails with the mutant"])

    def test_weighing_goes_on_after_a_crash(self):
        result = self.run_mutants(toy_mutant("crashes", "kill -SEGV $$"), weigh=True)
        self.assertEqual(sorted(result.killers), ["Slow.Waits", "Sum.Adds", "Sum.TakesZero"])

    def test_two_that_notice_it_are_enough(self):
        minus = toy_mutant("minus", MINUS, ["Sum.Adds"])  # Slow.Waits notices it, too, and so it is idle no more
        nine = toy_mutant("nine", "echo 9", ["Sum.Adds", "Sum.TakesZero"])
        first = self.run_mutants(minus, weigh=True)
        second = self.run_mutants(minus, nine, weigh=True)[1]
        self.assertEqual(sorted(first.killers), ["Slow.Waits", "Sum.Adds"])
        self.assertEqual(sorted(second.killers), ["Sum.Adds", "Sum.TakesZero"])
        last = [argument for _, argument, *_ in self.project.ran[-3:]]
        self.assertEqual(sorted(last), [f"--gtest_filter=Sum.{name}" for name in ("Adds", "IsSmall", "TakesZero")])

    def test_a_test_that_has_noticed_nothing_is_run_in_the_next_start(self):
        minus = toy_mutant("minus", MINUS, ["Sum.Adds"])
        self.run_mutants(minus, weigh=True)
        self.project.ran.clear()
        five = toy_mutant("five", "echo 5", ["Slow.Waits", "Sum.TakesZero"])
        self.assertEqual(self.run_mutants(minus, five, weigh=True)[1].killers, ["Sum.TakesZero", "Slow.Waits"])
        self.assertEqual(self.project.ran[-1][1], "--gtest_filter=Sum.IsSmall")

    def test_cheap_tests_come_first(self):
        self.run_mutants(toy_mutant("minus", MINUS))
        self.assertNotIn("Slow.Waits", self.project.ran[-1][1])
        result = self.run_mutants(toy_mutant("claimed", MINUS + " # claimed", ["Slow.Waits", "Sum.Adds"]))
        self.assertEqual(result.killed_by, "Sum.Adds")


class Starts(Runner):
    def test_what_fails_without_a_mutant_gives_no_table(self):
        script = self.project.root / "tests/toy.sh"
        script.write_text(script.read_text().replace("expected=8", "expected=9"))
        with self.assertRaisesRegex(Unusable, "test_toy .* fails without a mutant, in Slow.Waits"):
            self.run_mutants(toy_mutant("minus", MINUS))

    def test_a_second_start_goes_on(self):
        first, second = toy_mutant("first", MINUS), toy_mutant("second", HANGS.replace("1000", "0"))
        self.run_mutants(first)
        self.project.ran.clear()
        self.run_mutants(first, second)
        self.assertEqual(len(self.project.ran), 1)  # the second mutant
        self.run_mutants(first, again=True)
        self.assertEqual(len(self.project.ran), 2)

    def test_a_full_disk_is_no_outcome(self):
        full = toy_mutant("full", "echo $(($1 - $2) # No space left on device")
        with self.assertRaisesRegex(RuntimeError, "the build of test_toy failed: No space left on device"):
            self.run_mutants(full)
        self.assert_restored()

    def test_other_sources_are_tried_again(self):
        made = toy_mutant("minus", MINUS)
        self.run_mutants(made)
        self.project.ran.clear()
        with (self.project.root / "tests/toy.sh").open("a") as file:
            file.write("\n")
        self.run_mutants(made)
        self.assertEqual(len(self.project.ran), 2)  # without the mutant, and with it

    def test_a_line_that_is_not_whole_is_no_result(self):
        made = toy_mutant("minus", MINUS)
        self.run_mutants(made)
        file = self.project.place / "results.jsonl"
        whole = file.read_text()
        file.write_text(whole + whole[:40])
        sources = mutants.Digests(self.project.root)
        self.assertEqual(keep.Kept(file, sources).find(made, False).outcome, Outcome.KILLED)
        self.assertEqual(file.read_text(), whole)

    def test_several_workers(self):
        made = [toy_mutant(f"m{i}", f"{MINUS} # {i}", ["Sum.Adds"]) for i in range(5)]
        results = self.run_mutants(*made, jobs=2)
        self.assertEqual([(r.name, r.outcome) for r in results], [(m.name, Outcome.KILLED) for m in made])

    def test_control_c_ends_all_workers(self):
        hangs = toy_mutant("hangs", f"echo $$ >{self.project.root}/out/pid; {HANGS}")
        pid = self.project.root / "out/pid"
        pid.parent.mkdir()
        self.run_mutants(toy_mutant("minus", MINUS))
        unchanged = mutants.Unchanged(self.project, mutants.Digests(self.project.root))

        def interrupt(number, put):
            while not pid.exists():
                time.sleep(0.01)
            raise KeyboardInterrupt

        def work(number, put):
            copy = self.project.copy(number)
            trial.try_mutant(self.project, copy, unchanged.times, hangs)

        with self.assertRaises(KeyboardInterrupt):
            list(workers.side_by_side(2, lambda number, put: (work, interrupt)[number](number, put)))
        self.assert_restored()
        self.assertTrue(ends_soon(pid.read_text().strip()))


if __name__ == "__main__":
    unittest.main()
