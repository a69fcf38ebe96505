"""What the driver does when workers fail, stop, vanish, or have another program, and when the scheduler is lost."""

import io
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "farm"))

import driver as driver_module  # noqa: E402
import job  # noqa: E402
from blame import IN_A_ROW, Blame  # noqa: E402
from fake_engine import FakeEngine, Worker  # noqa: E402
from parts import Parts  # noqa: E402
from progress import Progress  # noqa: E402
from ranges import Range  # noqa: E402
from speed import Speed  # noqa: E402


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "scene.dae").write_text("scene")
        self.out = io.StringIO()

    def driver(self, workers, batches=16, size=2, write=None, return_parts=False, golden=False, patience=600.0):
        made = job.Job("program", self.folder / "scene.dae", 4 * batches, version="fake 1.0", golden=golden, pilot=8)
        parts = Parts(self.folder / "parts", made)
        self.addCleanup(parts.close)
        self.engine = FakeEngine(workers, write or (lambda task: pathlib.Path(task["part"]).write_text("part") and None))
        progress = Progress(0, batches, self.out, clock=self.engine.clock)
        speed = Speed(task_batches=size)
        return driver_module.Driver(
            lambda: self.engine, made, parts, speed, progress, return_parts, patience, self.engine.clock, self.engine.pause
        )

    def render(self, driver, batches=16):
        driver.render(Range(0, batches))
        self.assertEqual(driver.parts.missing(Range(0, batches)), [])
        self.assertEqual(driver.progress.done, batches)


class Tries(Case):
    def test_each_part_is_rendered_once(self):
        driver = self.driver({"a": Worker(), "b": Worker()})
        self.render(driver)
        begun = self.engine.all["a"].begun + self.engine.all["b"].begun
        self.assertEqual((len(begun), len(set(begun)), driver.counts.tasks), (8, 8, 8))
        self.assertTrue(self.engine.all["a"].begun and self.engine.all["b"].begun)

    def test_what_is_there_is_not_rendered(self):
        driver = self.driver({"a": Worker()})
        driver.parts.path(Range(2, 4)).write_text("there")
        driver.progress.done = 2
        self.render(driver)
        self.assertEqual(driver.counts.tasks, 7)
        self.assertEqual(driver.parts.path(Range(2, 4)).read_text(), "there")

    def test_a_failed_task_goes_elsewhere(self):
        seen = []

        def once(task):
            if task["arguments"][3] == "4..6" and not seen:
                seen.append(1)
                return "no memory"
            return None

        driver = self.driver({"a": Worker(fails=once), "b": Worker(fails=once)})
        self.render(driver)
        part = str(driver.parts.path(Range(4, 6)))
        self.assertEqual([self.engine.all[name].begun.count(part) for name in "ab"], [1, 1])
        self.assertIn("batches 4..6: failed at", self.out.getvalue())

    def test_the_same_error_at_three_workers_is_the_error_of_the_task(self):
        def always(task):
            return "scene.dae: element <x> is unknown" if task["arguments"][3] == "0..2" else None

        workers = {name: Worker(fails=always) for name in "abcde"}
        with self.assertRaisesRegex(job.JobError, r"^batches 0\.\.2: scene.dae: element <x> is unknown \(at 3 workers\)$"):
            self.render(self.driver(workers))
        part = [name for name in workers for path in workers[name].begun if "00000000-" in path]
        self.assertEqual((len(part), len(set(part))), (3, 3))

    def test_the_error_of_the_only_worker_ends_the_job(self):
        with self.assertRaisesRegex(job.JobError, r"full \(at 1 worker\)$"):
            self.render(self.driver({"a": Worker(fails="full")}))

    def test_a_worker_that_always_fails_is_used_no_more(self):
        driver = self.driver({"a": Worker(fails="full"), "b": Worker(), "c": Worker()}, batches=64)
        self.render(driver, 64)
        self.assertIn("a: failed several tasks in a row", self.out.getvalue())
        self.assertLessEqual(len(self.engine.all["a"].begun), 5)  # 3, and what waited for it

    def test_if_all_workers_fail_all_are_used(self):
        blame = Blame()
        for _ in range(IN_A_ROW):
            blame.failed("a")
        self.assertEqual(blame.usable({"a": 1, "b": 2}), {"b": 2})
        self.assertEqual(blame.usable({"a": 1}), {"a": 1})
        blame.succeeded("a")
        self.assertEqual(blame.usable({"a": 1, "b": 2}), {"a": 1, "b": 2})

    def test_a_returned_part_is_whole_or_not_there(self):
        driver = self.driver({"a": Worker()}, write=lambda task: b"content", return_parts=True)
        with mock.patch("os.fsync", side_effect=OSError(28, "No space left on device")):
            with self.assertRaisesRegex(job.JobError, "No space left on device"):
                self.render(driver)
        self.assertEqual([path.name for path in driver.parts.folder.iterdir() if "batches" in path.name], [])

    def test_a_part_that_is_not_visible_here_is_a_failure(self):
        driver = self.driver({"a": Worker()}, write=lambda task: None)
        with self.assertRaisesRegex(job.JobError, "--return-parts"):
            self.render(driver)

    def test_returned_parts_are_written_by_the_driver(self):
        driver = self.driver({"a": Worker(), "b": Worker()}, write=lambda task: b"content", return_parts=True)
        self.render(driver)
        self.assertEqual(driver.parts.path(Range(0, 2)).read_bytes(), b"content")
        self.assertEqual([path.name for path in driver.parts.folder.glob(".*tmp*")], [])


class Losses(Case):
    def test_a_lost_worker(self):
        driver = self.driver({"a": Worker(vanishes=1), "b": Worker()})
        self.render(driver)
        self.assertEqual(driver.counts.lost, 1)

    def test_a_task_with_which_workers_are_lost_ends_the_job(self):
        driver = self.driver({name: Worker(vanishes=0) for name in "abcd"}, batches=2)
        with self.assertRaisesRegex(job.JobError, "worker after worker"):
            self.render(driver, 2)

    def test_a_straggler_gets_a_second_copy(self):
        driver = self.driver({"a": Worker(), "b": Worker(stopped=True), "c": Worker()})
        self.render(driver)
        self.assertEqual(driver.counts.copies, 1)
        self.assertEqual(self.engine.allowed[-1], {"a", "c"})
        self.assertTrue(self.engine.cancelled)
        self.assertLess(self.engine.time, 60)

    def test_no_copies_while_nobody_is_slow(self):
        driver = self.driver({"a": Worker(seconds=10), "b": Worker(seconds=25)})
        self.render(driver)
        self.assertEqual(driver.counts.copies, 0)

    def test_workers_that_are_all_gone_give_their_tasks_back(self):
        driver = self.driver({"a": Worker(stopped=True), "b": Worker(stopped=True)})
        wait = self.engine.wait

        def exchange(seconds):
            if self.engine.time > 20:
                self.engine.all = {"c": Worker()}
            return wait(seconds)

        self.engine.wait = exchange
        self.render(driver)

    def test_no_worker(self):
        with self.assertRaisesRegex(job.JobError, "no worker for 30 seconds"):
            self.render(self.driver({}, patience=30.0))

    def test_a_foreign_program_is_refused(self):
        driver = self.driver({"a": Worker(version="fake 0.9"), "b": Worker()})
        self.render(driver)
        self.assertEqual(self.out.getvalue().count("a: is not used: it has fake 0.9, not fake 1.0"), 1)

    def test_nobody_has_this_version(self):
        with self.assertRaisesRegex(job.JobError, "no worker has this version"):
            self.render(self.driver({"a": Worker(version="fake 0.9")}))

    def test_the_scheduler_comes_back(self):
        driver = self.driver({"a": Worker(), "b": Worker()})
        self.engine.break_at, self.engine.broken_for = 5, 3
        self.render(driver)
        self.assertEqual(driver.counts.reconnections, 1)
        self.assertIn("connected again", self.out.getvalue())

    def test_the_scheduler_does_not_come_back(self):
        driver = self.driver({"a": Worker()}, patience=50.0)
        self.engine.break_at, self.engine.broken_for = 5, 1000
        with self.assertRaisesRegex(job.JobError, "no scheduler, for 50 seconds"):
            self.render(driver)
        self.assertLess(self.engine.time, 60)


if __name__ == "__main__":
    unittest.main()
