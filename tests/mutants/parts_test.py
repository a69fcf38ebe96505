"""The parts of the runner: heads, what GoogleTest prints, patches below a folder of another working tree, tables, the check."""

import contextlib
import io
import json
import os
import pathlib
import subprocess
import tempfile
import unittest
from unittest import mock

import check_patches
import gtest
import judged
import mutant
import sources
import tables
from keep import Outcome, Result
from mutant import Mutant
from project import Project
from toy import Toy, toy_mutant
from workers import Line

HEAD = "Title: A title\nOrigin: made by hand\nSymptom: too dark\nProgram: test_toy\nFails: Sum.Adds\n"


def patch(diff=None, head=HEAD):
    return f"{head}\n{diff or toy_mutant('m', 'echo 1').diff}"


class Heads(unittest.TestCase):
    def test_all_keys(self):
        more = "Passes: A.B, A.C\nSanitizer: thread\nPicture: s.dae --integrator bdpt\nRemoved: it\n"
        made = mutant.parse("m", patch(head=HEAD.replace("test_toy", "test_toy, test_b") + more))
        self.assertEqual((made.programs, made.fails, made.passes), (("test_toy", "test_b"), ("Sum.Adds",), ("A.B", "A.C")))
        self.assertEqual((made.preset, made.picture, made.removed), ("tsan", "s.dae --integrator bdpt", "it"))
        self.assertEqual(made.files, ["ref/sum/sum.sh"])

    def test_faults(self):
        for head, sentence in (
            (HEAD.replace("Origin", "Source"), "unknown key 'Source'"),
            (HEAD.replace("Symptom: too dark\n", ""), "has no Symptom"),
            (HEAD.replace("too dark", ""), "has no Symptom"),
            (HEAD + "Title: again\n", "twice"),
            (HEAD + "Sanitizer: memory\n", "unknown sanitizer memory"),
        ):
            with self.subTest(sentence), self.assertRaisesRegex(ValueError, f"m.patch: .*{sentence}"):
                mutant.parse("m", patch(head=head))
        with self.assertRaisesRegex(ValueError, "has no change"):
            mutant.parse("m", HEAD)

    def test_the_digest_sees_what_decides(self):
        first = toy_mutant("m", "echo 1", ["A.B"])
        others = [toy_mutant("m", "echo 2", ["A.B"]), toy_mutant("m", "echo 1", ["A.C"]), toy_mutant("m", "echo 1", sanitizer="thread")]
        self.assertNotIn(first.digest, [other.digest for other in others])
        self.assertEqual(first.digest, toy_mutant("other_name", "echo 1", ["A.B"]).digest)


class Digests(unittest.TestCase):
    def test_tests_of_another_program_do_not_count(self):
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)

            def changed_by(file):
                before = sources.Digests(root)
                path = root / file
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(file)
                after = sources.Digests(root)
                programs = ("test_ref_trees", "test_cuda", "relaxed_refit")
                return [p for p in programs if before.of_programs([p]) != after.of_programs([p])] + [before.of_all() != after.of_all()]

            self.assertEqual(changed_by("tests/ref/trees/box_test.cpp"), ["test_ref_trees", True])
            self.assertEqual(changed_by("tests/cuda/trees/box_test.cpp"), ["test_cuda", True])
            self.assertEqual(changed_by("tests/cuda/CMakeLists.txt"), ["test_cuda", True])
            self.assertEqual(changed_by("tests/CMakeLists.txt"), ["test_ref_trees", "test_cuda", "relaxed_refit", True])
            self.assertEqual(changed_by("tests/ref/trees/boxes.h"), ["test_ref_trees", "test_cuda", "relaxed_refit", True])
            self.assertEqual(changed_by("ref/box.cpp"), ["test_ref_trees", "test_cuda", "relaxed_refit", True])
            self.assertEqual(changed_by("docs/box.cpp"), [False])


class Configured(unittest.TestCase):
    def test_again_only_with_other_options(self):
        with tempfile.TemporaryDirectory() as name:
            project, folder = Project(pathlib.Path(name)), pathlib.Path(name, "0")
            configure, stamp, compile_program = project.commands_to_build(folder, "release", "test_toy")
            self.assertIn("-DPLUMBLINE_WARNINGS_AS_ERRORS=OFF", configure)
            pathlib.Path(stamp[-1]).parent.mkdir(parents=True)
            pathlib.Path(stamp[-1]).touch()
            self.assertEqual(project.commands_to_build(folder, "release", "test_toy"), [compile_program])
            os.rename(stamp[-1], stamp[-1] + "0")  # of an earlier version, with other options
            self.assertEqual(len(project.commands_to_build(folder, "release", "test_toy")), 3)


class GoogleTest(unittest.TestCase):
    def test_output(self):
        output = gtest.read_output(
            "[ RUN      ] S/A.B/0\nnoise[       OK ] S/A.B/0 (12 ms)\n"
            "[ RUN      ] S/A.B/1\nx\n[  FAILED  ] S/A.B/1, where GetParam() = (1, 2) (3 ms)\n"
            "[ RUN      ] T/0.C\n[  FAILED  ] T/0.C, where TypeParam = float (3 ms)\n"
            "[ RUN      ] A.D\n[  SKIPPED ] A.D (0 ms)\n"
            "[==========] 4 tests from 3 test suites ran. (18 ms total)\n"
            "[  FAILED  ] S/A.B/1, where GetParam() = (1, 2)\n"
        )
        self.assertEqual((output.passed, output.failed), ({"S/A.B/0": 0.012}, ["S/A.B/1", "T/0.C"]))
        self.assertTrue(output.complete)

    def test_output_that_ends_early(self):
        output = gtest.read_output("[ RUN      ] A.B\n[       OK ] A.B (1 ms)\n[ RUN      ] A.C\n")
        self.assertEqual((output.unfinished, output.complete), ("A.C", False))
        self.assertFalse(gtest.read_output("[ RUN      ] A.B\n[       OK ] A.B (1 ms)\n").complete)

    def test_a_race_is_in_the_test_before_the_warning(self):
        output = gtest.read_output("[ RUN      ] A.B\nWARNING: ThreadSanitizer: data race\n[       OK ] A.B (1 ms)\n[ RUN      ] A.C\n")
        self.assertEqual(output.racy, "A.B")

    def test_patterns(self):
        names = ["A.B", "A.BC", "S/A.B/0"]
        self.assertEqual(gtest.matching("A.*", names), ["A.B", "A.BC"])
        self.assertEqual(gtest.matching("*A.B*", names), names)

    def test_groups_are_cheap_first_and_hold_all(self):
        times = {f"A.{i}": i / 10 for i in range(40)}
        groups = gtest.groups(times)
        self.assertEqual([name for group in groups for name in group], sorted(times, key=times.get))
        self.assertLessEqual(sum(times[name] for name in groups[0]), 0.2)
        self.assertLess(len(groups), 15)


class Copies(unittest.TestCase):
    def test_a_patch_applies_in_a_folder_of_another_working_tree(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["git", "init", "-q", folder], check=True)
            inner = pathlib.Path(folder, "build/inner")
            project = Toy(inner)
            # With this line, git takes the paths as relative to the root of the working tree.
            diff = "diff --git a/ref/sum/sum.sh b/ref/sum/sum.sh\n" + toy_mutant("m", "echo 1").diff
            self.assertEqual(sources.apply(diff, inner, "--check"), "")
            self.assertEqual(sources.apply(diff, inner), "")
            self.assertIn("echo 1", (inner / "ref/sum/sum.sh").read_text())
            self.assertNotEqual(sources.apply(diff, inner, "--check"), "")
            self.assertIn("ref/sum/sum.sh", sources.listed(project.root))

    def test_only_what_changed_gets_a_new_time(self):
        with tempfile.TemporaryDirectory() as folder:
            project = Toy(folder)
            copy = project.copy(0)
            copy.bring_up_to_date()
            before = {name: (copy.folder / name).stat().st_mtime_ns for name in sources.listed(project.root)}
            (project.root / "build.sh").write_text("# other\n")
            (copy.folder / "left_over").write_text("")
            copy.bring_up_to_date()
            changed = [name for name, time in before.items() if (copy.folder / name).stat().st_mtime_ns != time]
            self.assertEqual(changed, ["build.sh"])
            self.assertFalse((copy.folder / "left_over").exists())


class Waiting(unittest.TestCase):
    def test_a_worker_stays_with_a_file_and_helps_at_the_end(self):
        made = [Mutant(f"{f}{i}", "", f"+++ b/ref/{f}\n", ("test_toy",)) for f, n in (("a", 5), ("b", 2)) for i in range(n)]
        line = Line(made)
        files = [line.next(worker).files[0] for worker in (0, 1, 1, 1, 0, 0, 0)]
        self.assertEqual(files, [f"ref/{f}" for f in "abbaaaa"])
        self.assertIsNone(line.next(0))
        self.assertIsNone(line.next(1))


class Tables(unittest.TestCase):
    times = {"release/test_toy": {"A.Cheap": 0.01, "A.Dear": 1.0, "A.Idle": 0.0}}
    mutants = [Mutant(name, name, "", ("test_toy",)) for name in "abcde"]
    results = [
        Result("a", "ref/x/f.cpp", "a", Outcome.KILLED, "A.Cheap", weighed=True, killers=["A.Cheap", "A.Dear"]),
        Result("b", "ref/x/g.cpp", "b", Outcome.TIMEOUT, "A.Dear", weighed=True, killers=["A.Dear"]),
        Result("c", "ref/y/h.cpp", "c", Outcome.SURVIVED, weighed=True),
        Result("d", "ref/y/h.cpp", "d", Outcome.SURVIVED, weighed=True, equivalent="the same"),
        Result("e", "ref/y/h.cpp", "e", Outcome.NO_BUILD, weighed=True, detail="error: |"),
    ]

    def test_json(self):
        table = json.loads(tables.as_json(self.mutants, self.results, self.times, {}))
        self.assertEqual(table["areas"], {"ref/x": {"killed": 2, "mutants": 2}, "ref/y": {"killed": 0, "mutants": 2}})
        self.assertEqual([(row["test"], row["kills"]) for row in table["cheapest"]], [("A.Cheap", 1), ("A.Dear", 1)])
        self.assertEqual(table["by_one_test"], {"b": "A.Dear"})
        self.assertEqual(table["tests_that_kill_nothing"], {"A.Idle": ""})

    def test_markdown(self):
        text = tables.as_markdown(self.mutants, self.results, self.times, {"date": "today"})
        for part in ("| all | 2 | 4 | 50% |", "- `c`: SURVIVED", "- `e`: does not build", "(equivalent: the same)", "1 of 2 (50%)", "1 of 3"):
            self.assertIn(part, text)

    def test_idle_tests_with_and_without_a_reason(self):
        without = tables.as_markdown(self.mutants, self.results, self.times, {})
        self.assertIn("Without a reason in `tests/mutants/idle.toml`: 1\n\n- `A.Idle`", without)
        reasons = {"B.*": "of other tests", "A.Id*": "it sees crashes"}
        reasoned = tables.as_markdown(self.mutants, self.results, self.times, {}, reasons)
        self.assertIn("| `A` | 1 | it sees crashes |", reasoned)
        self.assertNotIn("Without a reason", reasoned)
        self.assertNotIn("of other tests", reasoned)
        table = json.loads(tables.as_json(self.mutants, self.results, self.times, {}, reasons))
        self.assertEqual(table["tests_that_kill_nothing"], {"A.Idle": "it sees crashes"})

    def test_suites_stand_without_the_parts_of_an_instance(self):
        found = {"All/Sum.Adds/3": "r", "Typed/0.Works": "r", "All/Typed.Works": "r", "Other.Is": ""}
        self.assertEqual(tables._suites(found, "r"), ["`Sum`", "`Typed`"])

    def test_the_reason_of_an_instance_is_that_of_its_test(self):
        known = {"Sum.Adds": "of one", "Typed.*": "of types"}
        for test, reason in (("All/Sum.Adds/3", "of one"), ("Typed/0.Works", "of types"), ("Sum.Adds", "of one"), ("Sum.Subtracts", ""), ("Sum.AddsUp", "")):
            self.assertEqual(judged.reason_of(test, known), reason, test)

    def test_without_weighing_no_test_is_called_idle(self):
        results = [Result("a", "ref/x/f.cpp", "a", Outcome.KILLED, "A.Cheap")]
        self.assertNotIn("A.Idle", tables.as_markdown(self.mutants, results, self.times, {}))
        self.assertNotIn("tests_that_kill_nothing", tables.as_json(self.mutants, results, self.times, {}))


class Check(unittest.TestCase):
    def complaints(self, files, first="Sum.Adds", idle="Sum.*"):
        with tempfile.TemporaryDirectory() as folder:
            root, patches = Toy(folder).root, pathlib.Path(folder, "patches")
            (root / "CMakeLists.txt").write_text("add_executable(other other.cpp)\n")
            (root / "tests/CMakeLists.txt").write_text("plumbline_test_folder(toy SOURCES a.cpp)\n")
            (root / "tests/sum_test.cpp").write_text("TEST(Sum, Adds)\nRC_GTEST_PROP(Kinds, Fit,\nTYPED_TEST(Typed, Works)\n")
            (root / "tests/mutants").mkdir()
            (root / "tests/mutants/first_tests.txt").write_text(f"{first}\n")
            (root / "tests/mutants/idle.toml").write_text(f'[[tests]]\nnames = ["{idle}"]\nreason = "a reason"\n')
            patches.mkdir()
            for name, text in files.items():
                (patches / name).write_text(text)
            said = io.StringIO()
            with mock.patch.object(mutant, "PATCHES", patches), contextlib.redirect_stdout(said):
                status = check_patches.main(root)
            self.assertEqual(status, 1 if said.getvalue() else 0)
            return said.getvalue()

    def test_nothing_is_wrong(self):
        every = "Sum.*, All/Kinds.Fit/0, Typed/0.Works, *Adds"
        self.assertEqual(self.complaints({"m.patch": patch(head=HEAD.replace("Sum.Adds", every))}), "")

    def test_first_tests_exist(self):
        said = self.complaints({"m.patch": patch()}, first="Sum.Divides")
        self.assertIn("first_tests.txt: there is no test Sum.Divides", said)

    def test_idle_tests_exist(self):
        said = self.complaints({"m.patch": patch()}, idle="Sum.Div*")
        self.assertEqual(said, "tests/mutants/idle.toml: there is no test Sum.Div*\n")

    def test_faults(self):
        stale = patch(diff=toy_mutant("m", "echo 1").diff.replace("$1 + $2", "$1 * $2"))
        for files, sentence in (
            ({"m.patch": stale, "n.patch": patch()}, "m.patch does not apply: error"),
            ({"m.patch": patch(head=HEAD.replace("Sum.Adds", "Sum.Divides"))}, "there is no test Sum.Divides"),
            ({"m.patch": patch(head=HEAD.replace("test_toy", "test_boy"))}, "there is no program test_boy"),
            ({"m.patch": patch(head=HEAD.replace("Title", "Titel"))}, "unknown key 'Titel'"),
            ({"Name.patch": patch()}, "Name.patch: a mutant's file is"),
            ({"m.patch": patch(), "n.patch": patch()}, "n.patch: the same change as m.patch"),
        ):
            with self.subTest(sentence):
                said = self.complaints(files)
                self.assertIn(sentence, said)
                self.assertEqual(said.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
