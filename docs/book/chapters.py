"""The order of the book: its parts, and their pages in docs/."""

from pathlib import Path

PARTS = [
    ("Begin here", ["index.md", "one-sample.md", "ladder.md", "map.md"]),
    ("Light transport", ["bdpt.md", "derivations.md", "leaving-a-surface.md", "contacts.md", "explain.md"]),
    ("Trees", ["trees.md", "tree-by-hand.md"]),
    ("The fast path", ["cuda-trees.md", "cuda-bdpt.md", "stages.md", "gpu.md"]),
    ("Is it right?", ["comparison.md", "own-code.md", "export.md", "extremes.md", "mutants.md", "bugs.md"]),
    ("How fast is it?", ["trade.md", "peers.md", "farm.md"]),
    ("Your turn", ["exercises.md", "extending.md"]),
]


def navigation(docs: Path) -> list[dict]:
    """The navigation of MkDocs: the pages of PARTS that exist, then measurements, then pages that no part names."""
    parts = [(title, [page for page in pages if (docs / page).is_file()]) for title, pages in PARTS]
    parts.append(("Measurements", sorted(f"results/{page.name}" for page in docs.glob("results/*.md"))))
    named = {page for _, pages in parts for page in pages}
    parts.append(("More", sorted(page.name for page in docs.glob("*.md") if page.name not in named)))
    return [{title: pages} for title, pages in parts if pages]
