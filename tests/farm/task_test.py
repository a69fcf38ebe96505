"""What a worker does, with real processes."""

import os
import pathlib
import sys
import tempfile
import unittest
import zlib
from unittest import mock

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "farm"))

import task  # noqa: E402


class Tasks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "scene.dae").write_text("scene")
        self.part = self.folder / "batches_00000000-00000002.exr"

    def task(self, program=None, part="", **more):
        return {
            "program": str(program or HERE / "fake_plumbline.py"),
            "version": "fake 1.0",
            "arguments": ["render", "SCENE", "--batches", "0..2", "-o", "PART"],
            "files": {"SCENE": str(self.folder / "scene.dae")},
            "part": str(self.part) if part == "" else part,
            **more,
        }

    def left(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_a_part(self):
        self.assertEqual(task.run(self.task())["kind"], "done")
        self.assertEqual(self.left(), ["batches_00000000-00000002.exr", "scene.dae"])
        returned = task.run(self.task(part=None, files={"SCENE": ("scene.dae", zlib.compress(b"scene"))}))
        self.assertEqual(returned["bytes"], self.part.read_bytes())

    def test_an_error_is_one_line_and_leaves_nothing(self):
        script = self.folder / "program"
        script.write_text('#!/bin/sh\n[ $1 = --version ] && exec echo fake 1.0\necho notice >&2; echo "$6: no space" >&2\n: >$6; exit 2\n')
        script.chmod(0o755)
        answer = task.run(self.task(script))
        self.assertEqual((answer["kind"], answer["message"]), ("error", f"{self.part}: no space"))
        self.assertEqual(self.left(), ["program", "scene.dae"])

    def test_a_program_that_crashes_or_is_not_there(self):
        script = self.folder / "program"
        script.write_text("#!/bin/sh\n[ $1 = --version ] && exec echo fake 1.0\nkill -SEGV $$\n")
        script.chmod(0o755)
        self.assertEqual(task.run(self.task(script))["message"], "the program ended with status -11")
        answer = task.run(self.task(self.folder / "nothing"))
        self.assertEqual((answer["kind"], answer["message"]), ("error", f"No such file or directory: {self.folder / 'nothing'}"))

    def test_another_version(self):
        with mock.patch.dict(os.environ, {"FAKE_VERSION": "fake 2"}):
            answer = task.run(self.task())
        self.assertEqual((answer["kind"], answer["message"]), ("foreign", "fake 2"))

    def test_a_part_that_another_worker_has_made_meanwhile(self):
        script = self.folder / "program"
        script.write_text(f"#!/bin/sh\n[ $1 = --version ] && exec echo fake 1.0\n: >{self.part}\nexec sleep 100\n")
        script.chmod(0o755)
        with mock.patch.object(task, "LOOK_SECONDS", 0.05):
            answer = task.run(self.task(script))
        self.assertEqual(answer["kind"], "done")
        self.assertLess(answer["seconds"], 10)


if __name__ == "__main__":
    unittest.main()
