"""Every link of docs/ and of README.md leads to something: a file, a line that it has, a heading of a page."""

import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/book"))

import chapters  # noqa: E402

LINK = re.compile(r"\]\(([^)\s#]*)(?:#([^)\s]+))?\)")


def text_of(markdown: str) -> str:
    """Markdown without what it shows as code."""
    without_blocks = re.sub(r"^```.*?^```", "", markdown, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"^(?: {4}|\t).*$|`[^`\n]*`", "", without_blocks, flags=re.MULTILINE)


def anchors_of(markdown: str) -> set[str]:
    """The anchors of a page: of its headings as GitHub and the book make them, and those written as HTML."""
    without_blocks = re.sub(r"^```.*?^```", "", markdown, flags=re.MULTILINE | re.DOTALL)
    found = set(re.findall(r'<a (?:id|name)="([^"]+)"', without_blocks))
    for heading in re.findall(r"^#+ +(.*?) *$", without_blocks, flags=re.MULTILINE):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        found.add(re.sub(r"[^\w -]", "", plain).replace(" ", "-"))
    return found


def broken_links(root: Path, pages: list[Path]) -> list[str]:
    """What is wrong with the links of the pages."""
    faults = []
    for page in pages:
        markdown = page.read_text(encoding="utf-8")
        for path, anchor in LINK.findall(text_of(markdown)):
            if "://" in path or path.startswith("mailto:"):
                continue
            target = (page.parent / path).resolve() if path else page
            link = f"{page.relative_to(root)}: {path}{'#' + anchor if anchor else ''}"
            if not target.exists():
                faults.append(f"{link}: no such file")
            elif anchor and target.suffix == ".md":
                if anchor not in anchors_of(target.read_text(encoding="utf-8")):
                    faults.append(f"{link}: no such heading")
            elif anchor:
                lines = len(target.read_text(encoding="utf-8").splitlines()) if target.is_file() else 0
                if not re.fullmatch(r"L[1-9]\d*", anchor) or int(anchor[1:]) > lines:
                    faults.append(f"{link}: no such line")
    return faults


class Links(unittest.TestCase):
    def test_lead_to_what_exists(self):
        pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
        self.assertEqual(broken_links(ROOT, pages), [])

    def test_of_the_first_page_lead_to_every_chapter(self):
        linked = {path for path, _ in LINK.findall((ROOT / "docs/index.md").read_text(encoding="utf-8"))}
        docs = ROOT / "docs"
        pages = {str(page.relative_to(docs)) for page in [*docs.glob("*.md"), *docs.glob("results/*.md")]} - {"index.md"}
        self.assertEqual(pages - linked, set())

    def test_that_are_broken_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder).resolve()
            (root / "a.h").write_text("one\ntwo\n")
            (root / "b.md").write_text('# A heading: one\n<a id="by-hand"></a>\n')
            (root / "page.md").write_text("[1](a.h#L2) [2](b.md#a-heading-one) [3](b.md#by-hand) `[4](code)`\n")
            self.assertEqual(broken_links(root, [root / "page.md"]), [])
            (root / "page.md").write_text("[1](a.h#L3) [2](b.md#heading) [3](c.md) [4](#x) [5](a.h#two)\n")
            self.assertEqual([fault.split(": ")[1] for fault in broken_links(root, [root / "page.md"])],
                             ["a.h#L3", "b.md#heading", "c.md", "#x", "a.h#two"])


class Navigation(unittest.TestCase):
    def test_has_every_page_once(self):
        docs = ROOT / "docs"
        named = [page for part in chapters.navigation(docs) for pages in part.values() for page in pages]
        expected = sorted(str(page.relative_to(docs)) for folder in (docs, docs / "results") for page in folder.glob("*.md"))
        self.assertEqual(sorted(named), expected)
        self.assertEqual(named[0], "index.md")

    def test_has_pages_that_no_part_names_at_the_end(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("new.md", "trees.md"):
                (Path(folder) / name).write_text("# x")
            self.assertEqual(chapters.navigation(Path(folder)), [{"Trees": ["trees.md"]}, {"More": ["new.md"]}])


if __name__ == "__main__":
    unittest.main()
