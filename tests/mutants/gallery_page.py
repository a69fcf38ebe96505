"""The sections of docs/bugs.md, from the heads of the mutants that have a line Picture. gallery_page.py alone verifies that
the page is up to date, and exits with 1 if it is not."""

import re
import sys

from mutant import ROOT, Fault, patches

PAGE = "docs/bugs.md"
BEGIN = "<!-- from here on written by ./run gallery -->"
END = "<!-- up to here -->"


def test_links(mutant):
    """"`Suite.Name` in `test_program`", the tests that see it."""
    return f"{', '.join(f'`{test}`' for test in mutant.fails)} in `{mutant.programs[0]}`"


def section(mutant):
    yield from (f"### {mutant.title}", "", f"{mutant.symptom[0].upper()}{mutant.symptom[1:]}.", "")
    yield from (f"![right, wrong and their difference: {mutant.title}](images/bug_{mutant.name}.png)", "")
    yield from (mutant.cause, "")
    yield f"- *Where it happened:* {mutant.origin}."
    yield f"- *Seen by* {test_links(mutant)}."
    yield f"- *The mistake:* [`{mutant.name}`](../tests/mutants/patches/{mutant.name}.patch) in `{mutant.files[0]}`. *The pictures:* `plumbline render {mutant.picture}`."


def sections(mutants):
    pictured = sorted((mutant for mutant in mutants if mutant.picture), key=lambda mutant: mutant.title)
    for mutant in pictured:
        if not mutant.cause:
            raise Fault(f"{mutant.name}.patch: a mutant with a line Picture needs a line Cause")
    return "\n\n".join("\n".join(section(mutant)) for mutant in pictured)


def written(page, mutants):
    """The page with its sections. Raises Fault if it has not both marks, once each."""
    if page.count(BEGIN) != 1 or page.count(END) != 1 or page.index(BEGIN) > page.index(END):
        raise Fault(f"{PAGE}: it must have once the lines {BEGIN} and {END}")
    return re.sub(f"(?s){re.escape(BEGIN)}.*{re.escape(END)}", lambda _: f"{BEGIN}\n\n{sections(mutants)}\n\n{END}", page)


def main():
    page = (ROOT / PAGE).read_text(encoding="utf-8")
    if written(page, patches()) != page:
        print(f"{PAGE}: it is not what the mutants say; ./run gallery writes it")
        return 1
    missing = [mutant.name for mutant in patches() if mutant.picture and not (ROOT / "docs" / "images" / f"bug_{mutant.name}.png").is_file()]
    if missing:
        print(f"{PAGE}: no picture of {', '.join(missing)}; ./run gallery draws it")
    return 1 if missing else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Fault as fault:
        sys.exit(f"gallery: {fault}")
