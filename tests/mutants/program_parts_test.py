"""Parts of a real test program, of two files with tests and a library: which object files they need, and that a mutant is tried
in the part that holds the tests of its head."""

import io
import os
import pathlib
import shutil
import tempfile
import unittest

import mutants
from keep import Outcome
from mutant import Mutant
from parts import read_objects
from project import Project

FILES = {
    "lib/add.h": "int next(int);\nint twice(int);\n",
    "lib/one.h": "inline int one() { return 1; }\n",  # not of the tests: to compile these takes seconds
    "lib/next.cpp": '#include "lib/add.h"\n#include "lib/one.h"\nint next(int x) { return x + one(); }\n',
    "lib/twice.cpp": '#include "lib/add.h"\n#include "lib/one.h"\nint twice(int x) { return next(x) + x - one(); }\n',
    "tests/next_test.cpp": '#include <gtest/gtest.h>\n#include "lib/add.h"\n'
    "namespace { TEST(Next, OfTwoIsThree) { EXPECT_EQ(next(2), 3); }\n"
    "struct Numbers : testing::TestWithParam<int> {};\n"
    "TEST_P(Numbers, AreBeforeTheNext) { EXPECT_LT(GetParam(), next(GetParam())); }\n"
    'INSTANTIATE_TEST_SUITE_P(Small, Numbers, testing::Values(1, 2)); }\nconst char* helper() { return "tests/helper"; }\n',
    "tests/twice_test.cpp": '#include <gtest/gtest.h>\n#include "lib/add.h"\n#include <string>\n'
    "extern const char program[] = PROGRAM; template <class T> struct Twice : testing::Test {};\n"
    "using Types = testing::Types<int, long>; TYPED_TEST_SUITE(Twice, Types);\n"
    "TYPED_TEST(Twice, OfTwoIsFour) { EXPECT_EQ(TypeParam(twice(2)), 4); }\n",
    "tests/helper.cpp": "int main() {}\n",
    "build/release/build.ninja": "rule cxx\n  command = c++ -O0 -I../.. -DPROGRAM='\"$program\"' -MD -MF $out.d -c $in -o $out\n  depfile = $out.d\n"
    "rule ar\n  command = ar rcs $out $in\nrule link\n  command = : && c++ $in -o $out $libraries && :\n"
    "build next.o: cxx ../../lib/next.cpp\nbuild twice.o: cxx ../../lib/twice.cpp\nbuild lib.a: ar next.o twice.o\n"
    "build next_test.o: cxx ../../tests/next_test.cpp\nbuild helper.o: cxx ../../tests/helper.cpp\nbuild tests/helper: link helper.o\n"
    "build twice_test.o: cxx ../../tests/twice_test.cpp\n  program = FOLDER/tests/helper\n"
    "build tests/test_toy: link next_test.o twice_test.o | lib.a || tests/helper\n"
    "  libraries = lib.a -lgtest_main -lgtest -pthread\n",
}
DIFF = "--- a/lib/one.h\n+++ b/lib/one.h\n@@ -1 +1 @@\n-{}\n+{}\n"
ONE = "inline int one() { return 1; }"


class Toy(Project):
    def commands_to_build(self, folder, preset, program):
        built = folder / "build" / preset
        if not (built / "build.ninja").exists():
            built.mkdir(parents=True)
            (built / "build.ninja").write_text(FILES["build/release/build.ninja"].replace("FOLDER", str(built)))
        return [["ninja", "-C", str(built), f"tests/{program}"]]


@unittest.skipUnless(shutil.which("ninja"), "SKIPPED: ninja is not installed (./run test installs it)")
class Parts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Compiled once, since that takes seconds: the tests leave the copy as it is."""
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.project = Toy(pathlib.Path(temporary.name))
        for name, text in FILES.items():
            if not name.startswith("build/"):
                path = cls.project.root / name
                path.parent.mkdir(exist_ok=True)
                path.write_text(text)
        cls.folder = cls.project.place / "0"
        cls.built = cls.folder / "build/release"

    def read(self):
        self.project.copy(0).bring_up_to_date()
        self.assertEqual(self.project.build_unchanged(self.folder, "release", "test_toy"), "")
        return self.project.objects(self.folder, "release", "test_toy")

    def test_what_tests_need(self):
        objects = self.read()
        self.assertEqual(objects.with_tests(), ["next_test.o", "twice_test.o"])
        for tests, files in (
            (["Next.OfTwoIsThree"], ["next_test.o"]),
            (["Small/Numbers.AreBeforeTheNext/1"], ["next_test.o"]),
            (["Twice/1.OfTwoIsFour"], ["twice_test.o"]),
            (["Twice/0.OfTwoIsFour", "Next.OfTwoIsThree"], ["twice_test.o", "next_test.o"]),
            (["Next.OfTwo"], None),
        ):
            self.assertEqual(objects.of_tests(tests), files, tests)
        self.assertEqual(objects.part(["next_test.o"], "p").targets, ("next_test.o", "next.o"))
        # This one starts another program, which is built with it.
        self.assertEqual(objects.part(["twice_test.o"], "p").targets, ("twice_test.o", "twice.o", "next.o", "tests/helper"))

    def test_a_program_that_is_not_made_of_object_files(self):
        self.read()
        self.assertIsNone(read_objects(self.built, "lib.a"))

    def try_mutant(self, line, fails):
        mutant = Mutant("m", "title", DIFF.format(ONE, line), ("test_toy",), fails)
        said = io.StringIO()
        (result,), unchanged = mutants.try_chosen(self.project, [mutant], 1, out=said, status=said)
        times = unchanged.times["release/test_toy"]
        self.assertEqual(len(times), 5, times)  # each part ran on the unchanged sources
        return result

    def time_of(self, name):
        return os.stat(self.built / name).st_mtime_ns

    def test_only_the_part_is_compiled(self):
        self.read()
        before = {name: self.time_of(name) for name in ("next.o", "twice_test.o", "twice.o", "tests/test_toy")}
        result = self.try_mutant("inline int one() { return 2; }", ("Next.OfTwoIsThree",))
        self.assertEqual((result.outcome, result.killed_by), (Outcome.KILLED, "Next.OfTwoIsThree"))
        compiled = {name for name, time in before.items() if self.time_of(name) != time}
        self.assertEqual(compiled, {"next.o"})

    def test_a_survivor_is_tried_by_all_tests(self):
        result = self.try_mutant("inline int one() { return 3 - 2; }", ("Next.OfTwoIsThree",))
        self.assertEqual(result.outcome, Outcome.SURVIVED)

    def test_what_does_not_compile_is_no_kill(self):
        result = self.try_mutant("inline int one() { return }", ("Next.OfTwoIsThree",))
        self.assertEqual(result.outcome, Outcome.NO_BUILD)
        self.assertIn("error", result.detail)

    def test_a_mutant_that_needs_more_than_the_part(self):
        result = self.try_mutant("int twice(int); inline int one() { return twice(0); }", ("Next.OfTwoIsThree",))
        self.assertEqual((result.outcome, result.killed_by), (Outcome.CRASH, "Next.OfTwoIsThree"))  # an endless recursion


if __name__ == "__main__":
    unittest.main()
