"""./run mutants as a command: exit status, tables, names that are not there, and what it says on a terminal and elsewhere."""

import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import generate
import mutants
from keep import Outcome, Result
from progress import Progress
from toy import Toy, toy_mutant

KILLED = toy_mutant("minus", "echo $(($1 - $2))", ["Sum.Adds"])
SURVIVES = toy_mutant("swapped", "echo $(($2 + $1))", ["Sum.Adds"])


class Command(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.project = Toy(temporary.name)
        self.table = pathlib.Path(temporary.name, "out/table")

    def run_command(self, *arguments, known=(KILLED, SURVIVES)):
        """(exit status, standard output, standard error)"""
        by_name = {made.name: made for made in known}
        out, err = io.StringIO(), io.StringIO()
        with (
            mock.patch.object(mutants, "Project", lambda builders: self.project),
            mock.patch.object(mutants.mutant_file, "kept", lambda names: [by_name[name] for name in names or by_name]),
            mock.patch.object(sys, "argv", ["mutants.py", "-j", "1", "-o", str(self.table), *arguments]),
            contextlib.redirect_stdout(out),
            contextlib.redirect_stderr(err),
        ):
            try:
                status = mutants.guarded(mutants.main, "mutants")
            except SystemExit as end:
                status = end.code
        return status, out.getvalue(), err.getvalue()

    def test_all_killed(self):
        status, out, _ = self.run_command("minus")
        self.assertEqual(status, 0)
        self.assertIn("minus  killed by Sum.Adds  (build ", out)
        self.assertIn("1 of 1 mutants are killed", out)
        self.assertEqual(json.loads(self.table.with_suffix(".json").read_text())["outcomes"]["killed"], 1)
        self.assertIn("| `minus` |", self.table.with_suffix(".md").read_text())

    def test_one_survives(self):
        status, out, _ = self.run_command()
        self.assertEqual(status, 1)
        self.assertIn("1 of 2 mutants are killed", out)
        self.assertIn("Not as they should be: swapped", out)

    def test_a_wrong_claim(self):
        status, out, _ = self.run_command(known=[toy_mutant("minus", "echo $(($1 - $2))", ["Sum.IsSmall"])])
        self.assertEqual(status, 1)
        self.assertIn("  WRONG: no test that Fails names noticed it: Sum.IsSmall", out)

    def test_usage(self):
        for arguments, sentence in (
            (["nothing"], "there is no mutant nothing"),
            (["-j", "0"], "-j 0: at least one worker"),
            (["--sample", "3"], "--sample and --seed are for --generated"),
            (["--generated", "--sample", "1000000"], "--sample 1000000: there are "),
            (["--generated", "--sample", "0"], "--sample 0: there are "),
            (["--generated", "nothing"], "there is no mutant nothing"),
        ):
            with self.subTest(sentence):
                status, _, err = self.run_command(*arguments)
                self.assertEqual(status, 2)
                self.assertIn(sentence, err)

    def test_no_table_where_the_sources_fail(self):
        (self.project.root / "build.sh").write_text("echo 'error: no compiler'; exit 1\n")
        status, _, err = self.run_command()
        self.assertEqual(status, 1)
        self.assertEqual(err, "mutants: test_toy does not build without a mutant:\nerror: no compiler\n")
        self.assertFalse(self.table.with_suffix(".json").exists())

    def test_two_at_once(self):
        with mutants.alone(self.project.place):
            status, _, err = self.run_command()
        self.assertEqual(status, 1)
        self.assertIn("another runner uses", err)

    def test_sources_that_change_after_the_start(self):
        measure = mutants.workers.measure

        def slow(*arguments):
            measure(*arguments)
            (self.project.root / "ref/sum/new.sh").write_text("")

        with mock.patch.object(mutants.workers, "measure", slow):
            status, _, err = self.run_command()
        self.assertEqual((status, err), (1, "mutants: the sources have changed since the start: start again\n"))

    def test_a_list_tries_nothing(self):
        status, out, _ = self.run_command("--list", "minus")
        self.assertEqual((status, out), (0, "minus  title of minus\n"))
        self.assertEqual(self.project.ran, [])


    @unittest.skipIf(sys.version_info < (3, 11), "python3 is older than 3.11, which reads TOML")
    def test_generated_mutants_are_those_of_the_generator(self):
        status, out, _ = self.run_command("--generated", "--sample", "7", "--list")
        expected = [f"{made.name}  {made.title}" for made in generate.mutants(size=7)]
        self.assertEqual((status, out.splitlines(), len(expected)), (0, expected, 7))


class Words(unittest.TestCase):
    def test_on_a_terminal_and_elsewhere(self):
        terminal = io.StringIO()
        terminal.isatty = lambda: True
        for status, expected in ((io.StringIO(), ""), (terminal, "3 of 4; about 2 minutes left")):
            out = io.StringIO()
            progress = Progress(2, 4, 5, out, status)
            progress.begin -= 100
            progress.result(Result("m", "f", "", Outcome.SURVIVED))
            self.assertIn(expected, status.getvalue())
            self.assertEqual(out.getvalue(), "m      SURVIVED  (build 0.0 s, tests 0.0 s)\n")


if __name__ == "__main__":
    unittest.main()
