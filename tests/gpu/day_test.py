#!/usr/bin/env python3
"""day_test.py BUILD: day.sh lists its steps and skips them without a GPU, with the programs of BUILD; and it tells
passed, failed, skipped and timed-out steps apart, with programs that only print (fakes.py)."""
import json
import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import fakes
import readings
from day_case import HERE, Day
from steps import all_steps

BUILD = Path()


class WithTheRealBuild(Day):
    def names(self):
        return [step.name for step in all_steps(Path("b"), "s")]

    def test_a_dry_run_lists_every_step_with_its_commands(self):
        code, out, err = self.day("--dry-run", build=BUILD)
        lines = out.splitlines()
        self.assertEqual([line.split(":")[0] for line in lines if not line.startswith(" ")], self.names())
        for line, following in zip(lines, lines[1:]):
            self.assertTrue(line.startswith("    ") or following.startswith("    "), f"{line}: no command")
        programs = {word for step in all_steps(BUILD, "s") for word in step.programs}
        self.assertEqual(len(programs), 4)
        missing = [program for program in programs if not os.access(program, os.X_OK)]
        self.assertEqual(code, 2 if missing else 0, err)
        for program in missing:
            self.assertIn(str(program.relative_to(BUILD)), err)

    def test_without_a_gpu_every_step_is_skipped(self):
        if not all(os.access(BUILD / name, os.X_OK) for name in ("plumbline", "tests/test_cuda", "tests/test_renders", "tests/test_extremes")):
            self.skipTest("the build lacks a program")
        self.replace("bin/nvidia-smi", "echo 'NVIDIA-SMI has failed'; exit 9")
        code, out, err = self.day(build=BUILD)
        self.assertEqual(code, 77, err)
        self.assertIn("SKIPPED: no GPU: nvidia-smi: NVIDIA-SMI has failed; plumbline: built with", out)
        for name in self.names():
            self.assertRegex(out, rf"(?m)^{name}: .*\n    \S")
        self.assertEqual(list(self.steps()), self.names())
        for step in self.steps().values():
            self.assertEqual(step["status"], "skipped")
            self.assertIn("no GPU", step["reason"])
        self.assertEqual(json.loads(self.record.read_text())["counts"], {"skipped": len(self.names())})

    def test_the_limits_add_up_to_less_than_ten_minutes(self):
        self.assertLess(sum(step.limit for step in all_steps(Path("b"), "s")), 570)  # and half a minute around them


class WithFakes(Day):
    def test_everything_passes_and_the_numbers_are_kept(self):
        code, out, err = self.day()
        steps = self.steps()
        self.assertEqual({name: step["status"] for name, step in steps.items() if step["status"] != "passed"}, {}, err)
        self.assertEqual(code, 0)
        self.assertIn("sm_90", steps["gpu.device"]["numbers"]["described"])
        self.assertEqual(steps["gpu.tools"]["numbers"]["ncu"], str(self.tools / "ncu"))
        self.assertEqual(steps["tests.cuda"]["numbers"]["passed"], 2)
        self.assertEqual(steps["tests.cuda"]["numbers"]["milliseconds"]["Every/LbvhOn.B/device30"], 12)
        self.assertEqual(steps["sanitize.memcheck.tests"]["numbers"], {"errors": 0, "tests_passed": 2})
        self.assertEqual(steps["sanitize.racecheck.renders"]["numbers"]["bdpt stages"], {"errors": 0})
        for kernels in ("samples", "stages"):  # both: the first day with a GPU decides between them
            rate = steps["bench.pictures"]["numbers"][f"cornell_glass bdpt {kernels}"]["samples_per_second"]
            self.assertEqual(rate, {"rounds": [2e6] * 3, "mean": 2e6, "half_width_95": 0.0})
            self.assertIn(f"mesh_knot path {kernels}", steps["bench.renders"]["numbers"])
            for name in ("bench.renders", "bench.pictures", "sanitize.memcheck.renders", "ncu.path"):
                self.assertTrue(any(f"--kernels {kernels} " in command for command in steps[name]["commands"]), name)
        self.assertEqual(len(steps["bench.trees"]["numbers"]["million"]["morton30 sort ms"]["rounds"]), 5)
        launch = steps["ncu.bdpt"]["numbers"]["samples"]["launches"][1]
        self.assertEqual(launch["Registers Per Thread (register/thread)"], 128)
        self.assertEqual((launch["Grid Size"], launch["Achieved Occupancy (%)"]), (4096, 24.5))

    def test_a_failing_test_is_named(self):
        self.replace("build/tests/test_cuda", fakes.FAILING)
        step = self.expect("tests.cuda", "failed", "^Every/LbvhOn.C/device63 failed$", 1)
        self.assertEqual((step["numbers"]["passed"], len(step["numbers"]["failed"])), (2, 1))

    def test_a_crash_is_a_failure(self):
        self.replace("build/tests/test_cuda", fakes.CRASHING)
        self.expect("tests.cuda", "failed", "exit status -11 in OnDevice.Crashes", 1)

    def test_a_hanging_program_is_stopped_with_its_children_and_what_it_printed_is_kept(self):
        self.replace("build/tests/test_cuda", fakes.HANGING)
        step = self.expect("tests.cuda", "timed out", "stopped after", 1, "--limit", "0.8")
        self.assertEqual((step["numbers"]["passed"], step["numbers"]["did_not_end"]), (2, ["OnDevice.Hangs"]))
        child = int((self.build / "tests/test_cuda.child").read_text())
        self.assertFalse(fakes.exists(child))

    def test_skipped_tests_do_not_pass(self):
        self.replace("build/tests/test_cuda", fakes.ALL_SKIPPED)
        self.expect("tests.cuda", "skipped", "all 1 tests were skipped", 77)
        self.replace("build/tests/test_cuda", fakes.ONE_SKIPPED)
        step = self.expect("tests.cuda", "passed", "1 tests were skipped", 0)
        self.assertEqual((step["numbers"]["passed"], step["numbers"]["skipped"]), (2, ["OnDevice.D"]))
        self.replace("build/tests/test_cuda", "echo '[  PASSED  ] 0 tests.'")
        self.expect("tests.cuda", "failed", "no test ran", 1)

    def test_steps_whose_tool_is_missing_are_skipped(self):
        for tool in ("ncu", "compute-sanitizer", "nvidia-smi"):  # plumbline finds the GPU
            (self.tools / tool).unlink()
        for name in ("ncu.path", "sanitize.memcheck.tests", "gpu.driver"):
            self.expect(name, "skipped", "is not installed", 77)
        self.expect("gpu.device", "passed", "^$", 0)
        self.assertEqual(self.expect("gpu.tools", "passed", "^$", 0)["numbers"]["ncu"], "")

    def test_the_sanitizers_errors_and_refusals_are_failures(self):
        self.replace("bin/compute-sanitizer", fakes.SANITIZER_WITH_ERRORS)
        self.expect("sanitize.memcheck.renders", "failed", "path samples: 3 errors", 1)
        self.replace("bin/compute-sanitizer", fakes.SANITIZER_REFUSED)
        self.expect("sanitize.memcheck.tests", "failed", "no summary: Error: Device not supported", 1)
        self.replace("bin/compute-sanitizer", fakes.SANITIZER)
        self.replace("build/tests/test_cuda", "true")
        self.expect("sanitize.memcheck.tests", "failed", "no test ran", 1)

    def test_a_refused_profiler_is_a_failure(self):
        self.replace("bin/ncu", fakes.NCU_REFUSED)
        self.expect("ncu.path", "failed", "ERR_NVGPUCTRPERM", 1)

    def test_renders_and_builds_must_be_the_devices(self):
        self.replace("build/plumbline", fakes.PLUMBLINE.replace('"device":"cuda"', '"device":"host"'))
        self.expect("bench.pictures", "failed", "not rendered on the device", 1)
        self.expect("bench.trees", "failed", "not built on the device", 1)
        self.replace("build/plumbline", "echo 'plumbline: --device cuda: out of memory' >&2; exit 2")
        self.expect("bench.pictures", "failed", "exit status 2: plumbline: --device cuda: out of memory", 1)
        self.replace("build/plumbline", "echo Rendering")
        self.expect("bench.trees", "failed", "printed no JSON object", 1)

    def test_a_build_without_device_code_fails_beside_a_gpu(self):
        self.replace("build/plumbline", "echo 'GPU: built without nvcc'")
        self.expect("gpu.device", "failed", "built without nvcc", 1)

    def test_a_time_limit_keeps_the_rounds_that_ended(self):
        self.replace("build/plumbline", f'[ $(echo x >>"$0.n"; grep -c x "$0.n") -lt 10 ] || sleep 60\n{fakes.PLUMBLINE}')
        (self.tools / "grep").symlink_to("/bin/grep")
        step = self.expect("bench.pictures", "timed out", "in round 2 of 3", 1, "--limit", "2.5")
        rounds = [len(numbers["seconds"]["rounds"]) for numbers in step["numbers"].values()]
        self.assertEqual(sum(rounds), 9)

    def test_an_interrupted_run_keeps_what_it_has(self):
        self.replace("build/tests/test_renders", fakes.HANGING)
        with self.start("--steps", "tests,bench") as process:
            child = self.build / "tests/test_renders.child"
            deadline = time.monotonic() + 10
            while not (child.exists() and child.read_text()) and time.monotonic() < deadline:
                time.sleep(0.02)
            self.assertEqual(self.steps()["tests.cuda"]["status"], "passed")  # already written
            process.send_signal(signal.SIGTERM)
            _, err = process.communicate(timeout=10)
        self.assertEqual(process.returncode, 130, err)
        self.assertEqual(self.steps()["tests.cuda"]["numbers"]["passed"], 2)
        self.assertEqual([self.steps()[name]["reason"] for name in ("tests.renders", "bench.trees")],
                         ["interrupted", "not reached"])
        self.assertFalse(fakes.exists(int(child.read_text())))

    def test_an_earlier_record_is_kept_beside_the_new_one(self):
        self.record.write_text("earlier")
        self.expect("gpu.tools", "passed", "^$", 0)
        self.assertEqual((self.folder / "day.json.previous").read_text(), "earlier")
        self.assertEqual([path.name for path in self.folder.glob("day.json*") if path.suffix != ".previous"], ["day.json"])

    def test_bad_input_gives_one_line(self):
        (self.build / "tests/test_renders").unlink()
        for words, message in ((["--steps", "nothing"], "no step is called nothing"), (["--limit", "0"], "--limit"),
                               (["--no-such"], "--no-such"), (["-o", str(self.folder)], "is a folder"), ([], "lacks tests/test_renders"),
                               (["--build", str(self.folder / "none")], "there is no folder")):
            code, out, err = self.day_here(*words)
            self.assertEqual((code, out, err.count("\n")), (2, "", 1), err)
            self.assertIn(message, err)
        self.assertEqual(self.day_here("--steps", "tests.cuda")[0], 0)  # the missing program is not needed


class Carried(Day):
    def test_the_archive_holds_what_the_steps_need(self):
        for program in ("plumbline", "tests/test_cuda", "tests/test_renders", "tests/test_extremes"):
            (self.build / program).write_bytes(Path("/bin/true").read_bytes())
        archive = self.folder / "carried.tar.gz"
        subprocess.run(["bash", str(HERE / "carry.sh"), "--build", str(self.build), "-o", str(archive)], check=True,
                       stdout=subprocess.DEVNULL)
        subprocess.run(["tar", "-C", str(self.folder), "-xzf", str(archive)], check=True)
        place = self.folder / "plumbline"
        listed = subprocess.run(["bash", str(place / "tests/gpu/day.sh"), "--dry-run"], capture_output=True, text=True)
        self.assertEqual(listed.returncode, 0, listed.stderr)
        for word in listed.stdout.split():
            if word.startswith(("scenes/", "build/", "tests/gpu/")):
                self.assertTrue((place / word).is_file(), word)


class Intervals(unittest.TestCase):
    def test_are_students(self):
        found = readings.over_rounds([{"ms": 1.0, "n": 3}, {"ms": 2.0, "n": 3}, {"ms": 3.0, "n": 3}])
        self.assertEqual(found["n"], 3)
        self.assertEqual(found["ms"]["mean"], 2.0)
        self.assertAlmostEqual(found["ms"]["half_width_95"], 2.4843, places=4)  # 4.303 / sqrt(3)
        self.assertNotIn("half_width_95", readings.over_rounds([{"ms": 1.0}])["ms"])


if __name__ == "__main__":
    BUILD = Path(sys.argv.pop(1)).resolve()
    unittest.main()
