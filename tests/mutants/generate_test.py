"""The sample of generated mutants, their diffs and names on the present sources, and what was judged."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import generate
import judged
from cpp_source import Source
from mutant import Mutant
from operands import declared_types


def every():
    return [candidate for folder in generate.candidates().values() for candidate in folder]


class Sample(unittest.TestCase):
    def test_is_the_same_for_the_same_seed(self):
        found = generate.candidates()
        names = [c.name for c in generate.sample(found)]
        self.assertEqual(names, [c.name for c in generate.sample(found)])
        self.assertNotEqual(names, [c.name for c in generate.sample(found, seed=2)])
        self.assertEqual((len(names), len(set(names))), (generate.SAMPLE, generate.SAMPLE))

    def test_changes_little_where_a_mutant_goes(self):
        found = dict(generate.candidates())
        before = generate.sample(found)
        found["ref/trees"] = [c for c in found["ref/trees"] if c.name != before[0].name]
        self.assertLessEqual(len(set(before) - set(generate.sample(found))), 3)

    def test_changes_no_line_twice(self):
        lines = [(c.path, c.line) for c in generate.sample(generate.candidates(), 400)]
        self.assertEqual(len(lines), len(set(lines)))

    def test_gives_the_runner_a_mutant_for_each(self):
        chosen = generate.sample(generate.candidates(), 8)
        self.assertEqual([m.name for m in generate.mutants(size=8)], [c.name for c in chosen])
        mutant = generate.mutants([chosen[2].name])[0]
        self.assertEqual(mutant.programs, ("test_ref_transport",))
        self.assertEqual([f"{mutant.files[0]}:"], mutant.title.split()[:1])
        self.assertRaises(KeyError, generate.mutants, ["no_such_mutant"])

    def test_each_folder_has_its_share(self):
        self.assertEqual(generate.shares({"a": 300, "b": 100}, 100), {"a": 65, "b": 35})
        self.assertEqual(generate.shares({"a": 300, "b": 100}, 10), {"a": 5, "b": 5})


class PresentSources(unittest.TestCase):
    def test_names_are_unique(self):
        names = [c.name for c in every()]
        self.assertEqual(len(names), len(set(names)))

    def test_a_name_does_not_depend_on_the_place(self):
        text = (generate.ROOT / "ref/trees/refit.h").read_text()
        names = []
        for t in (text, text.replace("namespace ref {", "namespace ref {\n\nint n;\n", 1)):
            source = Source("ref/trees/refit.h", t)
            names.append({c.name for c in generate.candidates_of(source, declared_types([source]), "ref/trees")})
        self.assertGreater(len(names[0]), 0)
        self.assertEqual(names[0], names[1])

    def test_every_diff_applies(self):
        texts = {path: (generate.ROOT / path).read_text().splitlines(True) for path in {c.path for c in every()}}
        for c in every():
            begin, count, added = map(int, re.search(r"@@ -(\d+),(\d+) \+\1,(\d+) @@", c.diff).groups())
            hunk = c.diff.splitlines(True)[3:]
            old, new = ([line[1:] for line in hunk if line[0] in keep] for keep in (" -", " +"))
            self.assertEqual(old, texts[c.path][begin - 1 : begin - 1 + count], c.name)
            self.assertEqual(len(new), added, c.name)
            self.assertNotEqual(old, new, c.name)

    def test_git_applies_them(self):
        with tempfile.TemporaryDirectory() as folder:
            for candidates in generate.candidates().values():
                first = min(candidates, key=lambda c: c.name)
                pathlib.Path(folder, f"{first.name}.patch").write_text(first.diff)
            files = sorted(map(str, pathlib.Path(folder).iterdir()))
            result = subprocess.run(["git", "apply", "--check", *files], cwd=generate.ROOT, capture_output=True, text=True)
            self.assertEqual(result.stderr, "")


@unittest.skipIf(sys.version_info < (3, 11), "python3 is older than 3.11, which reads TOML")
class Judged(unittest.TestCase):
    def test_likely_tests_are_those_of_patches_of_the_same_file(self):
        patches = [
            Mutant("a", "a", "+++ b/ref/trees/x.h\n", ("test_ref_trees",), ("A.One", "A.Two")),
            Mutant("b", "b", "+++ b/ref/trees/x.h\n", ("test_ref_trees",), ("A.Two",)),
            Mutant("c", "c", "+++ b/ref/trees/x.h\n", ("test_ref_trees",), ("A.Races",), sanitizer="thread"),
            Mutant("d", "d", "+++ b/ref/trees/x.h\n", ("test_check",), ("A.Other",)),
            Mutant("e", "e", "+++ b/ref/trees/y.h\n", ("test_ref_trees",), ("A.OfAnotherFile",)),
        ]
        with mock.patch.object(generate, "_patches", lambda: patches):
            self.assertEqual(generate.likely("ref/trees/x.h", "ref/trees"), ("A.Two", "A.One"))
            self.assertEqual(generate.likely("ref/trees/z.h", "ref/trees"), ("A.Two", "A.One", "A.OfAnotherFile"))
            self.assertEqual(generate.likely("ref/transport/z.h", "ref/transport"), ())

    def test_what_was_judged_is_still_there(self):
        self.assertEqual(judged.faults({c.name for c in every()}), [])

    def test_an_entry_without_mutant_or_reason_is_a_fault(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "judged.toml")
            file.write_text('[there]\nequivalent = "both are 0"\n[gone]\nequivalent = "x"\n[empty]\nequivalent = " "\n')
            faults = judged.faults({"there", "empty"}, file)
            self.assertEqual([len(faults), "no mutant gone" in faults[0], "empty needs" in faults[1]], [2, True, True])
            self.assertEqual(judged.equivalent(file)["there"], "both are 0")


if __name__ == "__main__":
    unittest.main()
