"""How the book refers to sources, and what its check finds in a site."""

import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/book"))

import check  # noqa: E402
import sources  # noqa: E402

SOURCE = """// refit is explained here
#include "refit.h"
inline void other() {
    refit(tree);
}
void refit(Tree& tree)
{
}
"""


class Sources(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "ref").mkdir()
        (self.root / "docs/figures").mkdir(parents=True)
        (self.root / "ref/a.h").write_text(SOURCE)
        (self.root / "ref/README.md").write_text("# ref\n")
        (self.root / "docs/figures/c.toml").write_text("[c]\n")

    def test_have_names_where_they_are_declared(self):
        self.assertEqual(sources.line_of(SOURCE, "refit"), 6)  # no comment, no call
        self.assertEqual(sources.line_of(SOURCE, "ref::other"), 3)
        self.assertEqual(sources.line_of("    x = 1;\n", "x"), 1)
        self.assertIsNone(sources.line_of(SOURCE, "fit"))

    def test_are_linked_from_every_folder_of_pages(self):
        at = sources.with_links_to_pages
        self.assertEqual(at(self.root, "trees.md", "[a](../ref/a.h#L6)"), "[a](source/ref/a.h.md#L6)")
        self.assertEqual(at(self.root, "results/x.md", "[a](../../ref/a.h)"), "[a](../source/ref/a.h.md)")
        self.assertEqual(at(self.root, "trees.md", "[a](../ref)"), "[a](source/ref.md)")
        self.assertEqual(at(self.root, "trees.md", "[r](../ref/README.md)"), "[r](source/ref/README.md.md)")
        self.assertEqual(at(self.root, "results/x.md", "[t](../trees.md)"), "[t](../trees.md)")
        self.assertEqual(at(self.root, "trees.md", "[c](figures/c.toml)"), "[c](source/docs/figures/c.toml.md)")
        self.assertEqual(at(self.root, "trees.md", "[b](../ref/b.h)"), "[b](../ref/b.h)")  # for MkDocs to report

    def test_are_found_in_links_and_in_code_font(self):
        found = sources.referenced(self.root, "trees.md", "[a](../ref) and `ref/b.h`")
        self.assertEqual(found, {"ref", "ref/a.h", "ref/README.md"})
        self.assertEqual(sources.referenced(self.root, "trees.md", "`ref/a.h`: `refit`"), {"ref/a.h"})
        self.assertEqual(sources.referenced(self.root, "trees.md", "[out](../../other)"), set())

    def test_names_in_code_font_become_links(self):
        html = "<code>ref/a.h</code>: <code>refit</code> <code>ref/b.h</code> <a href='x'><code>ref/a.h</code></a>"
        self.assertEqual(
            sources.with_links_to_names(self.root, {"ref/a.h"}, "results/x.html", html),
            '<a class="source" href="../source/ref/a.h.html"><code>ref/a.h</code></a>: '
            '<a class="source" href="../source/ref/a.h.html#L6"><code>refit</code></a> '
            "<code>ref/b.h</code> <a href='x'><code>ref/a.h</code></a>")


class Check(unittest.TestCase):
    def faults(self, page: str, style: str = "") -> list[str]:
        with tempfile.TemporaryDirectory() as folder:
            site = Path(folder).resolve()
            (site / "index.html").write_text(page)
            (site / "other.html").write_text('<h1 id="there">x</h1>')
            (site / "a.css").write_text(style)
            return check.faults_of(site)

    def test_passes_what_is_there(self):
        self.assertEqual(self.faults('<a href="other.html#there">x</a><a href="#me" id="me">y</a>'
                                     '<a href="https://example.org/">z</a><link rel="stylesheet" href="a.css">',
                                     "p { background: url(data:image/png;base64,AA) }"), [])

    def test_finds_broken_links_and_what_is_loaded(self):
        for page, fault in {
                '<a href="no.html">x</a>': "no file", '<a href="other.html#nowhere">x</a>': "no anchor",
                '<a href="#nowhere">x</a>': "no anchor", '<img src="no.png">': "does not exist",
                '<script src="https://example.org/a.js"></script>': "network", '<img src="//example.org/a.png">': "network",
                '<link rel="preconnect" href="https://example.org">': "network",
                '<style>@import "https://example.org/a.css";</style>': "network",
                '<p style="background: url(http://example.org)">': "network"}.items():
            self.expect_one(fault, self.faults(page))
        self.expect_one("network", self.faults("", "@font-face { src: url(https://example.org/a.woff) }"))
        self.expect_one("does not exist", self.faults("", "@font-face { src: url('fonts/a.woff') }"))

    def expect_one(self, fault: str, found: list[str]):
        self.assertEqual([fault in one for one in found], [True], (fault, found))



if __name__ == "__main__":
    unittest.main()
