"""Follows links as a reader does who has not seen the code, from the first page of the documentation to twenty formulas.

    two_clicks.py ROOT

The first page is docs/index.md (without it, README.md). The first click leads to a page, and there the formula is found by
its name: on one line, the name, the formula and links to code. The second click is one of these links. It must lead to a line
of code that says, by its tag ("// map: fresnel") or by one in the comment just above it, that it is of this formula.
"""
import pathlib
import re
import sys

# What a reader looks for, and a part of the formula that must stand beside it.
FORMULAS = {
    "Morton code": r"x_0 y_0 z_0",
    "common prefix": r"\delta(i, j) =",
    "Split of a node": r"\gamma = i + s d",
    "Refit": r"B_{\text{left}} \cup B_{\text{right}}",
    "edge functions": r"U = C_x B_y - C_y B_x",
    "SAH cost": r"C_{\text{trav}} \frac{A}{A_{\text{root}}}",
    "Importance of the film": r"\frac{1}{A \cos^4\theta}",
    "two blocks of batches": r"\frac{n_a n_b}{n_a + n_b} (m_b - m_a)^2",
    "Choice of the emitter": r"\frac{\Phi_i}{\sum_j \Phi_j}",
    "Emission of a spot light": r"I \cos^n\theta",
    "Cosine sampling": r"p_\sigma = \frac{\cos\theta}{\pi}",
    "Fresnel's equations": r"\eta_t \cos\theta_i - \eta_i \cos\theta_t",
    "Eta squared": r"\left(\frac{\eta_i}{\eta_t}\right)^{2}",
    "Russian roulette": r"\alpha \leftarrow \alpha / q",
    "Geometric term": r"\lvert\cos\theta_x \cos\theta_y\rvert",
    "Area conversion": r"p_A(y) = p_\sigma(x \to y)",
    "inner connection": r"f_s(z_{t-1}) \alpha^E_t",
    "Densities p_i": r"\frac{p_{i+1}}{p_i}",
    "Balance heuristic": r"\frac{p_s}{\sum_i p_i}",
    "Power heuristic": r"\frac{p_s^2}{\sum_i p_i^2}",
}
LINK = re.compile(r"\]\(([^)#\s:]*)(?:#([^)\s]*))?\)")


def links(page: pathlib.Path, text: str) -> list[tuple[pathlib.Path, str]]:
    """The links in `text`, which is part of `page`, to files that exist, each with its anchor."""
    found = [((page.parent / file).resolve() if file else page, anchor or "") for file, anchor in LINK.findall(text)]
    return [(file, anchor) for file, anchor in found if file.is_file()]


def fault(pages: list[pathlib.Path], name: str, formula: str) -> str:
    """What keeps a reader from the formula, or nothing. A chapter may have it as well, without links to code."""
    found = [
        fault_of_line(page, line)
        for page in pages
        for line in page.read_text(encoding="utf-8").split("\n")
        if name in line and formula in line
    ]
    if not found:
        return "no page that the first page links to has it on one line with " + formula
    return "" if "" in found else found[-1]


def fault_of_line(page: pathlib.Path, line: str) -> str:
    anchor = re.search(r'<a id="([a-z0-9-]+)"></a>', line)
    if anchor is None:
        return f"{page.name} has no anchor there"
    folders = set()
    for file, place in links(page, line):
        if number := re.fullmatch(r"L(\d+)", place):
            lines = file.read_text(encoding="utf-8").split("\n")[: int(number[1])]
            there = lines[-1:]
            while len(there) < len(lines) and lines[-len(there) - 1].lstrip().startswith("//"):
                there = lines[-len(there) - 1 :]
            tag = re.compile(rf"// (?:.*; )?map: (?:.*, )?{anchor[1]}(?:,| \[|$)", re.M)
            if lines[-1].lstrip().startswith("//") or not tag.search("\n".join(there)):
                return f"{file.name}:{number[1]} has no tag {anchor[1]}"
            folders.add("tests" if "tests" in file.parts else "code")
    return "" if folders == {"tests", "code"} else "no link there leads to " + ({"code", "tests"} - folders).pop()


def main(root: pathlib.Path) -> int:
    root = root.resolve()
    first = root / "docs/index.md"
    if not first.is_file():
        first = root / "README.md"
    text = first.read_text(encoding="utf-8")
    pages = [first] + [page for page, _ in links(first, text) if page.suffix == ".md"]
    faults = {name: fault(pages, name, formula) for name, formula in FORMULAS.items()}
    for name, why in faults.items():
        if why:
            print(f"{first.relative_to(root)}: {name}: {why}")
    return 1 if any(faults.values()) else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
