"""Each fault that map.py and two_clicks.py must find, in a small tree of files that is otherwise right."""
import contextlib
import io
import pathlib
import tempfile
import unittest

import map as the_map
import two_clicks

TABLE = r"""
[commands]
show = "plumbline show"
[[step]]
section = "Surfaces"
name = "fresnel"
title = "Fresnel's equations"
formula = 'F = \frac{1}{2}'
paper = "Born & Wolf 1999, sec. 1.5.2"
shows = [["show", "words"], ["bsdf.md#2-glass-and-mirrors", "glass"]]
[[step]]
name = "sah"
title = "Split"
formula = 'A N'
paper = ""
shows = [["show", "words"]]
no_cuda = "Only the reference has it."
"""
FILES = {
    "docs/map.toml": TABLE,
    "docs/map.md": f"# Map\n{the_map.BEGIN}{the_map.END}After.\n",
    "docs/bsdf.md": "## 2. Glass and mirrors\n",
    "README.md": "[The map](docs/map.md)\n",
    "ref/bsdf.h": "int a;\nint f(); // map: fresnel [Born & Wolf 1999, sec. 1.5.2]\n",
    "ref/sah.h": "// map: sah\nint s();\n",
    "cuda/bsdf.h": "int f(); // Snell; map: fresnel\n",
    "tests/ref/bsdf_test.cpp": "TEST(Fresnel, HoldsOnBothSides) // map: fresnel\n{}\n// map: sah\nTEST(Sah, IsLeast)\n{}\n",
    "tests/cuda/bsdf_test.cpp": "// map: fresnel\n// By the path.\nRC_GTEST_PROP(FresnelInFloat,\n              Holds, ())\n",
}


class SmallTree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        for folder in the_map.COLUMNS["ref"] + the_map.COLUMNS["cuda"]:
            (self.root / folder).mkdir(exist_ok=True)
        for file, text in FILES.items():
            (self.root / file).parent.mkdir(parents=True, exist_ok=True)
            (self.root / file).write_text(text)
        self.assertEqual(self.run_map(""), "")

    def run_map(self, option="--check", *more):
        """What map.py prints. Its exit status must agree."""
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            status = the_map.main(self.root, option, *more)
        self.assertEqual(status, 1 if output.getvalue() else 0)
        return output.getvalue()

    def change(self, file, old, new):
        text = (self.root / file).read_text()
        self.assertEqual(text.count(old), 1, f"{file}: {old}")
        (self.root / file).write_text(text.replace(old, new))


class MapTest(SmallTree):
    def test_what_is_complete_passes_and_text_around_the_tables_stays(self):
        self.assertEqual(self.run_map(), "")
        page = (self.root / "docs/map.md").read_text()
        self.assertTrue(page.startswith("# Map\n") and page.endswith("After.\n"))
        row = next(line for line in page.split("\n") if 'id="fresnel"' in line)
        for link in ("[bsdf.h:2](../ref/bsdf.h#L2)", "[bsdf.h:1](../cuda/bsdf.h#L1)", "Fresnel: holds on both sides",
                     "[FresnelInFloat: holds](../tests/cuda/bsdf_test.cpp#L3)", "[glass](bsdf.md#2-glass-and-mirrors)"):
            self.assertIn(link, row)
        self.assertIn("[sah.h:2](../ref/sah.h#L2)", page)
        self.assertIn("Only the reference has it.", page)

    def test_a_line_that_moved_is_found_and_renewed(self):
        self.change("ref/bsdf.h", "int a;", "int a;\nint b;")
        self.assertIn("docs/map.md is not up to date (fresnel): ./run map renews it", self.run_map())
        self.assertEqual(self.run_map(""), "")
        self.assertEqual(self.run_map(), "")

    def test_a_change_of_the_table_is_found(self):
        self.change("docs/map.toml", "Fresnel's equations", "Fresnel")
        self.assertIn("not up to date (fresnel)", self.run_map())

    def test_a_row_that_is_gone_is_found(self):
        self.change("docs/map.md", "| <a id=\"sah\"></a>", "")
        self.assertIn("not up to date (sah)", self.run_map())

    def test_a_missing_tag_is_named_with_its_folder(self):
        for file, folder in (("ref/bsdf.h", "ref/"), ("cuda/bsdf.h", "cuda/"),
                             ("tests/ref/bsdf_test.cpp", "tests/ref/"), ("tests/cuda/bsdf_test.cpp", "tests/cuda/")):
            with self.subTest(file):
                self.change(file, "map: fresnel", "fresnel")
                self.assertRegex(self.run_map(), f"fresnel: no line in {folder}.* has the tag // map: fresnel")
                self.change(file, "fresnel", "map: fresnel")

    def test_a_wrong_name_is_found_with_the_nearest_one(self):
        self.change("ref/bsdf.h", "map: fresnel", "map: fresnell")
        self.assertIn("ref/bsdf.h:2: no step of docs/map.toml is called fresnell; there is fresnel", self.run_map())

    def test_a_tag_that_is_none_is_found(self):
        for tag in ("fresnel and more", "Fresnel", "fresnel,", "fresnel [Born] and more"):
            with self.subTest(tag):
                self.change("cuda/bsdf.h", "map: fresnel", f"map: {tag}")
                self.assertIn("cuda/bsdf.h:1: a tag is", self.run_map())
                self.change("cuda/bsdf.h", f"map: {tag}", "map: fresnel")

    def test_another_source_is_found(self):
        self.change("ref/bsdf.h", "sec. 1.5.2", "sec. 1.5.3")
        self.assertIn("ref/bsdf.h:2: cites [Born & Wolf 1999, sec. 1.5.3]", self.run_map())

    def test_a_tag_beside_no_test_is_found(self):
        self.change("tests/ref/bsdf_test.cpp", "TEST(Sah, IsLeast)", "int x;\nTEST(Sah, IsLeast)")
        self.assertIn("tests/ref/bsdf_test.cpp:3: a tag in tests/", self.run_map())

    def test_a_reason_is_needed_where_the_fast_path_has_no_line_and_only_there(self):
        self.change("docs/map.toml", 'no_cuda = "Only the reference has it."', "")
        self.assertIn("sah: no line in cuda/ or images/ has the tag // map: sah, and it has no no_cuda", self.run_map())
        self.change("docs/map.toml", "shows = [[\"show\", \"words\"], [", "no_cuda = \"\"\nshows = [[\"show\", \"words\"], [")
        self.assertIn("fresnel: no_cuda, and there are tags in cuda/", self.run_map())

    def test_what_shows_a_step_must_exist(self):
        self.change("docs/map.toml", "bsdf.md#2", "bsdf.md#3")
        self.assertIn("docs/bsdf.md has no heading #3-glass-and-mirrors", self.run_map())
        self.change("docs/map.toml", "bsdf.md#3", "bsfd.md#2")
        self.assertIn("no file docs/bsfd.md", self.run_map())
        self.change("docs/map.toml", '[["show", "words"], ["bsfd.md#2-glass-and-mirrors", "glass"]]', "[]")
        self.assertIn("fresnel: neither a command nor a figure shows it", self.run_map())

    def test_a_command_that_nothing_uses_and_a_name_given_twice_are_found(self):
        self.change("docs/map.toml", "[commands]", '[commands]\nunused = "plumbline"')
        self.change("docs/map.toml", 'name = "sah"', 'name = "fresnel"')
        self.assertIn("no step uses the command unused", self.run_map())
        self.assertIn("two steps are called fresnel", self.run_map())

    def test_signs_that_markdown_changes_are_found(self):
        for sign in ("|", "<", "*", r"\,", r"\{", "$"):
            with self.subTest(sign):
                self.change("docs/map.toml", "'A N'", f"'A {sign} N'")
                self.assertIn(f"sah: Markdown would change {sign}", self.run_map())
                self.change("docs/map.toml", f"'A {sign} N'", "'A N'")

    def test_commands_are_run_and_must_print_their_words(self):
        program = self.root / "program"
        program.write_text('#!/bin/sh\necho "$1 words"\n')
        program.chmod(0o755)
        self.assertEqual(self.run_map("--run", str(program)), "")
        program.write_text('#!/bin/sh\necho other\n')
        self.assertIn('fresnel: the command show does not print "words"', self.run_map("--run", str(program)))
        program.write_text('#!/bin/sh\necho why >&2; exit 2\n')
        self.assertIn("show ends with status 2: why", self.run_map("--run", str(program)))


class TwoClicksTest(SmallTree):
    """A reader who looks for Fresnel's equations in the same tree."""

    def fault(self, name="Fresnel's equations", formula=r"F = \frac{1}{2}"):
        first = self.root / "README.md"
        pages = [page for page, _ in two_clicks.links(first, first.read_text())]
        return two_clicks.fault(pages, name, formula)

    def test_two_clicks_lead_there(self):
        self.assertEqual(self.fault(), "")
        self.assertEqual(self.fault(name="Split", formula="A N"), "")

    def test_a_first_page_without_the_link_is_found(self):
        self.change("README.md", "docs/map.md", "docs/bsdf.md")
        self.assertIn("no page", self.fault())

    def test_another_name_or_formula_is_found(self):
        self.assertIn("no page", self.fault(name="Snell"))
        self.assertIn("no page", self.fault(formula=r"F = \frac{1}{3}"))

    def test_a_link_to_another_line_is_found(self):
        self.change("ref/bsdf.h", "int a;", "int a;\nint b;")
        self.assertEqual(self.fault(), "bsdf.h:2 has no tag fresnel")

    def test_code_between_tag_and_line_is_found(self):
        self.change("ref/sah.h", "// map: sah", "// map: sah\nint b;")
        self.assertEqual(self.fault(name="Split", formula="A N"), "")
        self.change("docs/map.md", "[sah.h:2](../ref/sah.h#L2)", "[sah.h:3](../ref/sah.h#L3)")
        self.assertEqual(self.fault(name="Split", formula="A N"), "sah.h:3 has no tag sah")

    def test_a_line_of_another_formula_is_found(self):
        self.change("cuda/bsdf.h", "map: fresnel", "map: fresnel-more")
        self.assertEqual(self.fault(), "bsdf.h:1 has no tag fresnel")

    def test_a_row_without_tests_is_found(self):
        page = self.root / "docs/map.md"
        page.write_text(page.read_text().replace("../tests/", "../none/"))
        self.assertEqual(self.fault(), "no link there leads to tests")


if __name__ == "__main__":
    unittest.main(argv=["map_self_test"], verbosity=0)
