"""./run figures in a small repository: what it finds stale, what it overwrites, and what it says."""

import contextlib
import gzip
import io
import json
import os
import shutil
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "docs", "figures"))

import figure_compare
import figures
import keep_results
from figure_table import begin_mark

DOT = """
[dot]
pictures = ["dot.svg"]
text = "docs/page.md"
draw = 'echo "<svg>dot</svg>" >"$images/dot.svg"; echo "| 1 |"'
"""
PAGE = f"![a dot](images/dot.svg)\n\n{begin_mark('dot')}\n\n| 1 |\n\n<!-- up to here -->\n\nThe end.\n"


class Figures(unittest.TestCase):
    def setUp(self):
        self.root = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.root)
        os.makedirs(os.path.join(self.root, "docs", "figures"))
        os.makedirs(os.path.join(self.root, "docs", "images"))
        self.table(DOT)
        self.write("docs/page.md", PAGE)
        self.write("docs/images/dot.svg", "<svg>dot</svg>\n")

    def write(self, path, text):
        with open(os.path.join(self.root, path), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, path):
        with open(os.path.join(self.root, path), encoding="utf-8") as file:
            return file.read()

    def table(self, text):
        self.write("docs/figures/figures.toml", text)

    def run_figures(self, *arguments):
        """Exit status, and everything that is printed."""
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            status = figures.main(["--root", self.root, *arguments])
        return status, printed.getvalue()

    def expect(self, status, part, *arguments):
        found, printed = self.run_figures(*arguments)
        self.assertEqual(found, status, printed)
        self.assertIn(part, printed)
        return printed

    def test_what_is_as_drawn_passes(self):
        self.expect(0, "Everything is as drawn.", "--check")
        self.expect(0, "", "--table")

    def test_a_check_finds_what_is_stale_or_missing_and_overwrites_nothing(self):
        self.write("docs/images/dot.svg", "<svg>old</svg>\n")
        self.expect(1, "docs/images/dot.svg: stale: it has the line: <svg>old</svg>", "--check")
        self.expect(1, "docs/images/dot.svg: stale", "--check", "dot.svg")
        self.assertEqual(self.read("docs/images/dot.svg"), "<svg>old</svg>\n")
        os.remove(os.path.join(self.root, "docs/images/dot.svg"))
        self.expect(1, "docs/images/dot.svg: missing", "--check")
        self.assertEqual(os.listdir(os.path.join(self.root, "docs/images")), [])

    def test_a_check_finds_a_table_that_is_stale(self):
        self.write("docs/page.md", PAGE.replace("| 1 |", "| 2 |"))
        self.expect(1, "docs/page.md: stale: it has the line: | 2 |", "--check")
        self.assertIn("| 2 |", self.read("docs/page.md"))

    def test_drawing_names_first_what_it_overwrites_and_keeps_the_rest(self):
        self.write("docs/images/dot.svg", "old")
        self.write("docs/page.md", PAGE.replace("| 1 |", "| 2 |\n| 3 |"))
        printed = self.expect(0, "docs/images/dot.svg: stale")
        first = printed.index("May be overwritten:\n  docs/images/dot.svg\n  docs/page.md")
        self.assertLess(first, printed.index("stale"))
        self.assertEqual(self.read("docs/images/dot.svg"), "<svg>dot</svg>\n")
        self.assertEqual(self.read("docs/page.md"), PAGE)
        self.assertEqual(os.listdir(os.path.join(self.root, "docs/images")), ["dot.svg"])

    def test_text_can_be_code(self):
        self.table(DOT.replace("draw =", "indent = 4\ndraw ="))
        self.expect(0, "overwritten")
        self.assertEqual(self.read("docs/page.md"), PAGE.replace("| 1 |", "    | 1 |"))

    def test_commands_that_fail_change_nothing(self):
        for draw, said in (("echo half >\"$images/dot.svg\"; echo no disk >&2; exit 3", "failed with status 3: no disk"),
                           ("true", "did not draw dot.svg"),
                           ("touch \"$images/dot.svg\" \"$images/b.svg\"", "drew also b.svg")):
            self.table(f"[dot]\npictures = ['dot.svg']\ndraw = '{draw}'")
            self.expect(2, said)
            self.assertEqual(self.read("docs/images/dot.svg"), "<svg>dot</svg>\n")

    def test_the_table_and_the_pages_name_every_picture_once(self):
        self.write("docs/images/other.svg", "")
        printed = self.expect(1, "docs/images/other.svg: no figure draws it", "--table")
        self.assertIn("docs/images/other.svg: no page shows it", printed)
        os.remove(os.path.join(self.root, "docs/images/other.svg"))
        self.table(DOT + DOT.replace("[dot]", "[again]").replace('text = "docs/page.md"\n', ""))
        self.expect(1, "docs/images/dot.svg: several figures draw it", "--table")
        self.table(DOT + "[b]\npictures = ['b.svg']\ndrawn_by = './run b'")
        self.expect(1, "docs/images/b.svg: missing", "--table")
        self.table(DOT)
        self.write("docs/page.md", PAGE + '![](images/gone.png)\n<img width="9" src="images/dot.svg">')
        self.expect(1, "docs/page.md: shows docs/images/gone.png, which is missing", "--table")

    def test_text_needs_its_marks(self):
        for page in ("", PAGE.replace("<!-- up to here -->", ""), PAGE + PAGE):
            self.write("docs/page.md", "![a dot](images/dot.svg)" + page)
            self.expect(1, "docs/page.md: ", "--table")
        self.write("docs/page.md", PAGE + begin_mark("nobody"))
        self.expect(1, "docs/page.md: no figure nobody", "--table")

    def test_a_table_that_is_wrong_is_an_error_of_one_line(self):
        for text, said in (("[dot", "figures.toml"), ("[dot]\nshape = 1", "[dot]: unknown key shape"), ("dot = 1", "[dot]"),
                           ("[dot]\npictures = 'a.svg'", "must be a list"), ("[dot]\npictures = ['a.svg']", "draw or drawn_by"),
                           ("[dot]\ndraw = 'true'", "pictures or text"), ("[dot]\npictures = ['../a.svg']\ndraw = 'b'", "no name"),
                           (DOT + "needs = ['luck']", "luck"), (DOT + "compare = 'by eye'", "by eye")):
            self.table(text)
            printed = self.expect(2, said, "--check")
            self.assertEqual(printed.count("\n"), 1, printed)
        self.table(DOT)
        self.expect(2, "no such figure: cow", "--check", "cow")

    def test_says_what_it_cannot_check(self):
        self.table(DOT + "data = ['docs/data.json']\nmeasured_by = './run measure dot'")
        self.expect(0, "Not checked: dot: docs/data.json is missing, which ./run measure dot writes", "--check")
        self.expect(2, "docs/data.json is missing", "--check", "dot")

    def test_needs_the_course_scenes_and_takes_no_others(self):
        os.makedirs(os.path.join(self.root, "scenes"))
        self.table(DOT + "needs = ['course scenes']")
        for shared in (None, "", os.path.join(self.root, "docs")):
            os.environ.pop("PLUMBLINE_SHARED", None)
            if shared is not None:
                os.environ["PLUMBLINE_SHARED"] = shared
            with contextlib.chdir(self.root):
                status, out = self.run_figures("--check")
            self.assertEqual(status, 0)
            self.assertIn("course scenes", out)

    def test_keeps_what_is_drawn_of_a_walk(self):
        point = {"parameter": 1 / 3, "cases": 4, "errors": 3, "median": 0.0, "largest": 1 / 3, "failures": {}, "refusal": "",
                 "notice": "n", "not_walked": ""}
        axes = [{"name": name, "about": "...", "methods": [{"name": "ref", "safe": None, "points": [point]}]} for name in "abc"]
        self.write("walk.json", json.dumps({"format": "f", "complete": True, "axes": axes}))
        source, target = (os.path.join(self.root, name) for name in ("walk.json", "kept.json.gz"))
        keep_results.main(source, target, "--without", "a", "c")
        with gzip.open(target) as file:
            kept = json.load(file)
        self.assertEqual(kept, {"format": "f", "complete": True, "axes": [{"name": "b", "methods": [{"name": "ref", "points": [
            {"parameter": 1 / 3, "cases": 4, "errors": 3, "largest": 0.333333}]}]}]})
        self.write("walk.json", json.dumps({"complete": False, "axes": axes}))
        self.assertRaises(SystemExit, keep_results.main, source, target)

    def test_plots_may_differ_in_edges_and_text_and_not_in_what_is_plotted(self):
        try:
            from PIL import Image, ImageDraw
        except ImportError:
            self.skipTest("python3-pil is not installed (./run figures installs it)")

        def plot(name, x, color="#d55e00", text="1"):
            picture = Image.new("RGB", (400, 200), "white")
            drawing = ImageDraw.Draw(picture)
            drawing.text((300, 20), text, fill="black")
            drawing.line((0, 100, 400, 100), fill="#0072b2", width=3)
            drawing.rectangle((x, 150, x + 20, 162), fill=color)
            path = os.path.join(self.root, name)
            picture.save(path)
            return path

        first = plot("a.png", 40)
        self.assertEqual(figure_compare.difference(first, plot("b.png", 40), "bits"), "")
        self.assertEqual(figure_compare.difference(first, plot("b.png", 41, text="2"), "plot"), "")
        self.assertIn("pixels differ", figure_compare.difference(first, plot("b.png", 41), "bits"))
        for other in (plot("c.png", 45), plot("d.png", 40, "#b8a000"), plot("e.png", 40, "white")):
            self.assertIn("of the coloured pixels", figure_compare.difference(first, other, "plot"))
            self.assertIn("of the coloured pixels", figure_compare.difference(other, first, "plot"))


if __name__ == "__main__":
    unittest.main()
