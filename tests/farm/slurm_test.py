"""farm/slurm_array.sh, its elements started by hand: parts that merge into what one render makes."""

import os
import pathlib
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SCRIPT = HERE.parents[1] / "farm/slurm_array.sh"
PROGRAM = HERE / "fake_plumbline.py"


class Array(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.scene, self.parts = self.folder / "scene.dae", self.folder / "parts"
        self.scene.write_text("scene")

    def element(self, index, tasks, samples=80, **more):
        environment = dict(os.environ, PLUMBLINE=str(PROGRAM), SLURM_ARRAY_TASK_ID=str(index), TASKS=str(tasks), **more)
        return subprocess.run([SCRIPT, self.scene, self.parts, str(samples)], env=environment, capture_output=True, text=True)

    def names(self):
        return sorted(path.name for path in self.parts.iterdir())

    def merged(self, *more):
        out = self.folder / "whole.exr"
        command = [PROGRAM, "merge", *sorted(self.parts.iterdir()), "-o", out, "-s", "80", *more]
        subprocess.run(command, check=True)
        return out.read_text()

    def test_a_render(self):
        for index in (2, 0, 1):
            self.assertEqual(self.element(index, 3).stderr, "")
        self.assertEqual(len(self.names()), 20)
        whole = self.merged()
        subprocess.run([PROGRAM, "render", self.scene, "--batches", "0..20", "-o", self.folder / "single.exr"], check=True)
        self.assertEqual(whole, (self.folder / "single.exr").read_text())

    def test_parts_are_aligned_and_not_rendered_again(self):
        self.element(0, 1, 44 * 4)
        self.assertEqual(self.names(), [f"batches_{at:08}-{min(at + 8, 44):08}.exr" for at in range(0, 44, 8)])
        damaged, whole = (self.parts / name for name in self.names()[:2])
        damaged.write_text("not a part")
        before = whole.stat().st_mtime_ns
        self.element(0, 1, 44 * 4)
        self.assertIn("checksum", damaged.read_text())
        self.assertEqual(whole.stat().st_mtime_ns, before)

    def test_a_golden(self):
        self.element(0, 1, PILOT="6", GOLDEN="pilot")
        self.assertEqual(self.names(), ["pilot.exr"])
        self.assertEqual(self.element(0, 1, PILOT="6", GOLDEN="rest").stderr, "")
        self.assertEqual(self.names()[:2], ["batches_00000006-00000008.exr", "batches_00000008-00000010.exr"])
        self.assertTrue(self.merged("--finish").startswith("finished golden"))

    def test_usage(self):
        for more, said in (
            ({"samples": 81}, "not a whole number"),
            ({"tasks": "0"}, "'0' is no number"),
            ({"GOLDEN": "x"}, "must be pilot or rest"),
            ({"index": "x"}, "not set"),
            ({"index": 3}, "element 3 of 3"),
        ):
            answer = self.element(**{"index": 0, "tasks": 3, **more})
            self.assertEqual(answer.returncode, 2)
            self.assertRegex(answer.stderr, f"^slurm_array.sh: .*{said}.*\n$")


if __name__ == "__main__":
    unittest.main()
