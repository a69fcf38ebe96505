"""The whole command with a program of text parts (fake_plumbline.py), in this process: the result, errors, damage, Ctrl-C."""

import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "farm"))

import farm  # noqa: E402
import fake_plumbline  # noqa: E402
import task as task_module  # noqa: E402
from flight import Event  # noqa: E402


class Inline:
    """An engine of one worker that does each task when it is waited for. `stop_after`: Ctrl-C after so many tasks."""

    def __init__(self, stop_after=None, environment=None):
        self.tasks, self.stop_after, self.environment = [], stop_after, environment or {}
        self.done, self.closed = 0, False

    def workers(self):
        return {"here": 1}

    def submit(self, task, allowed):
        self.tasks.append(task)
        return len(self.tasks) - 1

    def wait(self, seconds):
        waiting = self.tasks
        self.tasks = []
        events = []
        for task in waiting:
            if self.stop_after == self.done:
                raise KeyboardInterrupt
            self.done += 1
            with mock.patch.dict(os.environ, self.environment):
                events.append(Event(len(events), "here", task_module.run(task)))
        return events

    def where(self, attempt):
        return None

    def cancel(self, attempts):
        pass

    def close(self):
        self.closed = True


def run_here(command, **_):
    """In place of a process, which takes longer than all of these tests: the program's own functions."""
    words = [str(word) for word in command]
    out, errors, status = io.StringIO(), io.StringIO(), 0
    old = os.getcwd()
    try:
        os.chdir(_.get("cwd") or old)
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            fake_plumbline.main(words[1:])
    except SystemExit as end:
        status = end.code
    finally:
        os.chdir(old)
    encode = str if _.get("text") else str.encode
    return mock.Mock(returncode=status, stdout=encode(out.getvalue()), stderr=encode(errors.getvalue()))


def program_here(command, final):
    answer = run_here(command)
    return answer.returncode, answer.stderr.decode()


class OneByOne:
    """In place of threads: the program in this process knows of one folder at a time."""

    groups = [1]

    def __init__(self, threads):
        pass

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def map(self, function, *lists):
        made = [function(*items) for items in zip(*lists)]
        self.groups.append(len(made))
        return made


class Command(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.scene, self.whole = self.folder / "scene.dae", self.folder / "whole.exr"
        self.scene.write_text("a scene")
        self.parts = self.folder / "whole.exr.parts"
        for patch in (
            mock.patch.dict(os.environ, {"PLUMBLINE": str(HERE / "fake_plumbline.py")}),
            mock.patch("subprocess.run", run_here),
            mock.patch.object(task_module, "_program", program_here),
        ):
            patch.start()
            self.addCleanup(patch.stop)

    def farm(self, *options, engine=None, samples=64):
        """(exit status, standard error)"""
        self.engine = engine or Inline()
        words = [str(self.scene), "-s", str(samples), "-o", str(self.whole), *options]
        with contextlib.redirect_stderr(io.StringIO()) as errors:
            try:
                status = farm.main(words, lambda _: self.engine)
            except SystemExit as usage:
                status = usage.code
        return status, errors.getvalue()

    def single(self, command="render", *more, end=16):
        path = self.folder / "single"
        fake_plumbline.main([command, str(self.scene), "--batches", f"0..{end}", "-o", str(path), *more])
        return path.read_bytes()

    def test_the_bytes_of_one_render(self):
        status, said = self.farm()
        self.assertEqual(status, 0, said)
        self.assertEqual(self.whole.read_bytes(), self.single())
        self.assertTrue(self.engine.closed)
        self.assertRegex(said, r"whole.exr: \d+ tasks; \d+ s\n$")

    def test_many_parts_are_merged_in_groups(self):
        for processors in (1, 2, 3):
            self.whole.unlink(missing_ok=True)
            with mock.patch("merge.processors", lambda: processors), mock.patch("merge.concurrent.futures.ThreadPoolExecutor", OneByOne):
                status, said = self.farm("--task-batches", "1", samples=200)
            self.assertEqual((status, self.whole.read_bytes()), (0, self.single(end=50)), said)
            self.assertEqual(OneByOne.groups.pop(), {1: 1, 2: 2, 3: 3}[processors])
        self.assertEqual(list(self.parts.glob(".*tmp*")), [])

    def test_parts_that_come_back(self):
        status, said = self.farm("--return-parts", "--task-batches", "4")
        self.assertEqual((status, self.whole.read_bytes()), (0, self.single()), said)

    def test_a_golden_has_its_pilot_first(self):
        golden = ["--golden", "--pilot", "8", "--parts", str(self.parts)]
        status, said = self.farm(*golden, "--task-batches", "16")
        self.assertEqual(status, 0, said)
        names = sorted(path.name for path in self.parts.glob("batches_*"))
        self.assertEqual(names, ["batches_00000000-00000008.exr", "batches_00000008-00000016.exr"])
        self.assertTrue(self.whole.read_text().startswith("finished golden"))
        self.assertEqual(self.farm(*golden), (0, f"{self.whole}: is there\n"))
        self.whole.write_bytes(next(self.parts.glob("batches_*")).read_bytes())
        status, said = self.farm(*golden)
        self.assertEqual(status, 2)
        self.assertRegex(said, f"^farm: {self.whole}: is not finished: .*\n$")

    def test_ctrl_c_and_a_second_start(self):
        status, said = self.farm("--task-batches", "2", engine=Inline(stop_after=3))
        self.assertEqual(status, 130)
        self.assertIn("the same command goes on from here", said)
        self.assertTrue(self.engine.closed)
        there = {path: path.stat().st_mtime_ns for path in self.parts.glob("batches_*")}
        self.assertEqual(len(there), 3)
        self.assertEqual(self.farm("--task-batches", "2")[0], 0)
        self.assertEqual(self.whole.read_bytes(), self.single())
        self.assertEqual({path: path.stat().st_mtime_ns for path in there}, there)

    def test_more_samples_need_only_the_rest(self):
        self.farm("--task-batches", "8")
        status, said = self.farm("--task-batches", "8", samples=128)
        self.assertEqual((status, self.whole.read_bytes()), (0, self.single(end=32)), said)
        self.assertIn(": 2 tasks", said)

    def test_a_damaged_part_is_rendered_again(self):
        self.farm("--task-batches", "8")
        part = sorted(self.parts.glob("batches_*"))[0]
        part.write_text(part.read_text().replace("batch 3", "batch 4"))
        status, said = self.farm("--task-batches", "8")
        self.assertEqual((status, self.whole.read_bytes()), (0, self.single()))
        self.assertIn("batches_00000000-00000008.exr: damaged: the checksum is not that of the content; it is rendered again", said)

    def test_damage_that_only_the_merge_finds(self):
        def damage(task):
            answer = run(task)
            if len(damaged) < 1:
                damaged.append(1)
                pathlib.Path(task["part"]).write_text("not a part")
            return answer

        run, damaged = task_module.run, []
        with mock.patch.object(task_module, "run", damage):
            status, said = self.farm("--task-batches", "4")
        self.assertEqual((status, self.whole.read_bytes()), (0, self.single()), said)

    def test_damage_that_does_not_end_ends_the_job(self):
        def damage(task):
            answer = run(task)
            pathlib.Path(task["part"]).write_text("not a part")
            return answer

        run = task_module.run
        with mock.patch.object(task_module, "run", damage):
            status, said = self.farm("--task-batches", "16")
        self.assertEqual(status, 2)
        self.assertRegex(said.splitlines()[-1], "^farm: batches_00000000-00000016.exr: damaged")
        self.assertFalse(self.whole.exists())

    def test_the_error_of_the_program(self):
        status, said = self.farm(engine=Inline(environment={"FAKE_FAIL": "notice\nscene.dae:3: <x> is unknown"}))
        self.assertEqual(status, 2)
        self.assertEqual(said.splitlines()[-1], "farm: batches 0..1: scene.dae:3: <x> is unknown (at 1 worker)")

    def test_another_version_at_the_worker(self):
        status, said = self.farm(engine=Inline(environment={"FAKE_VERSION": "fake 0.9"}))
        self.assertEqual((status, said.splitlines()[-1]), (2, "farm: no worker has this version of the program (fake 1.0)"))

    def test_parts_of_another_picture(self):
        self.farm()
        status, said = self.farm("--", "--size", "8x8")
        self.assertEqual((status, said), (2, f"farm: {self.parts}: holds parts of another picture (other options): name another --parts\n"))
        self.assertEqual(self.farm("--", "-t", "3")[0], 0)  # threads change no bit

    def test_usage(self):
        for words, said in (
            (["--batch", "7"], "not a whole number of batches"),
            (["--task-batches", "3"], "must be a power of two"),
            (["--pilot", "3"], "--pilot is for --golden"),
            (["--golden"], "needs more batches than the 32"),
            (["--", "--strategies", "x.exr"], "--strategies among the options"),
            (["--", "-s", "4"], "-s among the options"),
            (["--workers", "0"], "must be at least 1"),
        ):
            status, errors = self.farm(*words)
            self.assertEqual(status, 2, words)
            self.assertIn(said, errors)
        self.scene.unlink()
        self.assertEqual(self.farm(), (2, f"farm: {self.scene}: there is no such scene file\n"))


if __name__ == "__main__":
    unittest.main()
