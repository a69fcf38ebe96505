"""A mutant: one mistake as a change of the sources, which the tests must notice.

One that is kept is a file of patches/, NAME.patch: a head of lines "Key: value", an empty line, and the change as `git diff`
writes it. The keys:

    Title:     what is wrong, in a few words
    Origin:    where the mistake was made (a public issue, a page), or the text that warns of it; or "made by hand"
    Symptom:   what a user sees
    Program:   the test programs that can see it (CMake targets), the cheapest first, separated by commas
    Fails:     tests that must fail with it, the cheapest first, separated by commas; gtest's wildcards are allowed
    Passes:    (may be absent) tests of the first program that must pass in spite of it
    Sanitizer: (may be absent) "thread": Fails needs a build with ThreadSanitizer. Passes are run without it
    Picture:   (may be absent) arguments of `plumbline render` for a picture that shows it
    Cause:     (may be absent) a paragraph on cause and cure, in one line of Markdown. With it, the picture is in the gallery
    Removed:   (exercises only) what the patch takes away: it completes "without ..."

For a program that is no test program (its name does not begin with test_), Fails and Passes are its arguments. The generator
makes mutants without a file.
"""

import dataclasses
import hashlib
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
PATCHES = pathlib.Path(__file__).with_name("patches")
KEYS = ("Title", "Origin", "Symptom", "Program", "Fails", "Passes", "Sanitizer", "Picture", "Cause", "Removed")
NEEDED = KEYS[:5]
PRESETS = {"": "release", "thread": "tsan"}  # by sanitizer


@dataclasses.dataclass(frozen=True)
class Mutant:
    """`diff`: what `git apply` gets. `fails` may be empty: then any test of `programs` may notice it, and those that `likely`
    names are tried first. `equivalent`: the reason why no test can see it, of a mutant for which this was shown; it may survive."""

    name: str
    title: str
    diff: str
    programs: tuple[str, ...]
    fails: tuple[str, ...] = ()
    passes: tuple[str, ...] = ()
    sanitizer: str = ""
    origin: str = "generated"
    symptom: str = ""
    picture: str = ""
    cause: str = ""
    removed: str = ""
    equivalent: str = ""
    likely: tuple[str, ...] = ()

    @property
    def files(self):
        """Paths of the files that it changes, from the root."""
        return re.findall(r"^\+\+\+ b/(\S+)", self.diff, re.MULTILINE)

    @property
    def preset(self):
        """The CMake preset of the build in which Fails are run."""
        return PRESETS[self.sanitizer]

    @property
    def digest(self):
        """A hash of all that the outcome depends on, except the sources."""
        told = (self.diff, self.programs, self.fails, self.passes, self.sanitizer, self.equivalent)
        return hashlib.sha256(repr(told).encode()).hexdigest()[:16]


def parse(name, text):
    """The mutant of a patch with a head. Raises ValueError with one sentence if the head is not as described above."""
    head, empty_line, diff = text.partition("\n\n")
    lines = [line.partition(": ") for line in head.splitlines()]
    if wrong := [key for key, colon, _ in lines if not colon or key not in KEYS]:
        raise ValueError(f"{name}.patch: unknown key {wrong[0]!r} (there are {', '.join(KEYS)})")
    values = {key: value.strip() for key, _, value in lines}
    if len(values) < len(lines):
        raise ValueError(f"{name}.patch: a key occurs twice")
    if missing := [key for key in NEEDED if not values.get(key)]:
        raise ValueError(f"{name}.patch: has no {missing[0]}")
    if not empty_line or not re.search(r"^\+\+\+ b/\S", diff, re.MULTILINE):
        raise ValueError(f"{name}.patch: has no change (--- a/..., +++ b/...) after an empty line")
    if "Cause" in values and "Picture" not in values:
        raise ValueError(f"{name}.patch: Cause is for the gallery, and needs Picture")
    if values.get("Sanitizer", "") not in PRESETS:
        raise ValueError(f"{name}.patch: unknown sanitizer {values['Sanitizer']} (there is thread)")

    def listed(key):
        return tuple(part for part in re.split(r",\s*", values.get(key, "")) if part)

    return Mutant(
        name=name,
        title=values["Title"],
        diff=diff,
        programs=listed("Program"),
        fails=listed("Fails"),
        passes=listed("Passes"),
        sanitizer=values.get("Sanitizer", ""),
        origin=values["Origin"],
        symptom=values["Symptom"],
        picture=values.get("Picture", ""),
        cause=values.get("Cause", ""),
        removed=values.get("Removed", ""),
    )


def kept(names=(), folder=PATCHES):
    """The mutants of patches/ with these names, in this order, or all. Raises KeyError for an unknown name, ValueError for a
    patch that cannot be read."""
    known = {path.stem: path for path in sorted(folder.glob("*.patch"))}
    return [parse(name, known[name].read_text()) for name in (dict.fromkeys(names) or known)]
