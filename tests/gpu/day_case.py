"""What the tests of day_test.py share: a folder with fakes, and ways to run day.sh in it."""
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from unittest import mock

import day
import fakes

HERE = Path(__file__).resolve().parent


class Day(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.build, self.tools, self.record = self.folder / "build", self.folder / "bin", self.folder / "day.json"
        fakes.make_build(self.build)
        fakes.make_tools(self.tools)
        self.environment = {"PATH": str(self.tools), "CUDA_HOME": str(self.folder), "CUDA_VISIBLE_DEVICES": "",
                            "TMPDIR": str(self.folder)}

    def arguments(self, words, build=None):
        record = [] if "--dry-run" in words else ["-o", str(self.record)]
        return ["--build", str(build or self.build), *record, *words]

    def start(self, *words, build=None):
        return subprocess.Popen(["bash", str(HERE / "day.sh"), *self.arguments(words, build)], env=self.environment,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def day(self, *words, build=None):
        """Runs day.sh. Returns exit status and output."""
        with self.start(*words, build=build) as process:
            out, err = process.communicate(timeout=30)
            return process.returncode, out, err

    def day_here(self, *words):
        """The same without starting another Python, to save time."""
        out, err = io.StringIO(), io.StringIO()
        with mock.patch.dict(os.environ, self.environment, clear=True), redirect_stdout(out), redirect_stderr(err), \
                mock.patch.object(sys, "argv", ["day.py", *self.arguments(words)]):
            return day.main(), out.getvalue(), err.getvalue()

    def steps(self):
        return {step["name"]: step for step in json.loads(self.record.read_text())["steps"]}

    def replace(self, program, text):
        fakes.write_program(self.folder / program, text)

    def expect(self, name, status, reason, code, *words):
        """Runs one step. Returns its record."""
        returned, _, err = self.day_here("--steps", name, *words)
        step = self.steps()[name]
        self.assertEqual((step["status"], returned), (status, code), (step, err))
        self.assertRegex(step["reason"], reason)
        return step
