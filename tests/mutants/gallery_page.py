"""The sections of docs/bugs.md, from the heads of the mutants that have a line Cause. Alone, this verifies that the page is
up to date and that each picture is there: prints what is wrong, and exits with 1 if anything is.
"""

import re
import sys

import mutant

PAGE = "docs/bugs.md"
BEGIN = "<!-- from here on written by ./run gallery -->"
END = "<!-- up to here -->"


def anchor(title):
    """The address of a section, as GitHub and MkDocs make it."""
    return re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", title.lower()))


def sentence(text):
    return text[0].upper() + text[1:] + ("" if text.endswith(".") else ".")


def index(pictured):
    """By what one sees."""
    yield "| what you see | what it may be |"
    yield "|---|---|"
    for made in sorted(pictured, key=lambda made: (made.symptom.lower(), made.title)):
        yield f"| {made.symptom} | [{made.title}](#{anchor(made.title)}) |"


def section(made):
    tests = ", ".join(f"`{test}`" for test in made.fails)
    yield f"## {made.title}"
    yield sentence(made.symptom)
    yield f"![right, wrong, difference: {made.title}](images/bug_{made.name}.png)"
    yield made.cause
    happened = "" if made.origin.startswith("made by hand") else f"Where it happened: {made.origin}. "
    yield (
        f"{happened}Seen by {tests}. The mistake is "
        f"[`{made.name}.patch`](../tests/mutants/patches/{made.name}.patch) in `{made.files[0]}`, the picture `plumbline render {made.picture}`."
    )


def sections(mutants):
    pictured = sorted((made for made in mutants if made.cause), key=lambda made: made.title)
    return "\n\n".join(["\n".join(index(pictured)), *(part for made in pictured for part in section(made))])


def written(page, mutants):
    """The page with its sections. Raises ValueError if it has not both marks, once each."""
    if page.count(BEGIN) != 1 or page.count(END) != 1 or page.index(BEGIN) > page.index(END):
        raise ValueError(f"{PAGE} must have the lines {BEGIN} and {END}, once")
    before, _, rest = page.partition(BEGIN)
    return f"{before}{BEGIN}\n\n{sections(mutants)}\n\n{END}{rest.partition(END)[2]}"


def faults():
    page, mutants = (mutant.ROOT / PAGE).read_text(), mutant.kept()
    if written(page, mutants) != page:
        yield "the heads of the mutants say something else (./run gallery writes the page)"
    for made in mutants:
        if made.cause and not (mutant.ROOT / "docs" / "images" / f"bug_{made.name}.png").is_file():
            yield f"there is no picture of {made.name} (./run gallery draws it)"


def main():
    found = list(faults())
    for fault in found:
        print(f"{PAGE}: {fault}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
