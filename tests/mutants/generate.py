"""Generated mutants: small changes of one line of ref/ or cuda/, such as + for - (the kinds are in *_kinds.py).

    python3 -B tests/mutants/generate.py              one line for each mutant of a sample; --help tells how to choose it
    python3 -B tests/mutants/generate.py --list       for all that there are
    python3 -B tests/mutants/generate.py --diff NAME  the change itself

The name of a mutant is made of its file, its kind and a hash of the line before and after: it stays the same when lines
move. So does the sample of a seed, where the sources stay the same. judged.toml tells of mutants that no test can see.
"""

import argparse
import collections
import dataclasses
import functools
import hashlib
import re
import sys

import judged
import name_kinds as names
import operator_kinds as operators
import statement_kinds as statements
from cpp_source import Source
from mutant import ROOT, Mutant, kept
from operands import declared_types

# The test programs that see a change in a folder, the cheapest first.
PROGRAMS = {
    "ref/trees": ("test_ref_trees", "test_ref_transport"),
    "ref/transport": ("test_ref_transport",),
    "cuda/trees": ("test_cuda",),
    "cuda/transport": ("test_cuda", "test_extremes"),  # probes.h is for the second
}
KINDS = [
    *(operators.plus_minus, operators.times_over, operators.drop_factor, operators.forget_call, operators.less),
    *(operators.equal, operators.and_or, operators.min_max, operators.drop_not, operators.drop_minus, operators.relaxed),
    *(operators.constant, operators.shift_mask, operators.flip_bool),
    *(names.off_by_one, names.swapped_axis, names.swapped_name, names.swapped_arguments),
    *(statements.negate_condition, statements.skip_update, statements.drop_guard),
]
SAMPLE, SEED, LEAST_OF_A_FOLDER = 80, 1, 20
LIKELY = 6  # tests of a mutant that are tried first
CONTEXT = 3  # lines of a diff around the change


@dataclasses.dataclass(frozen=True)
class Candidate:
    name: str
    folder: str
    kind: str
    path: str
    line: int  # the first that changes, from 1
    original: str  # whole lines
    replaced: str
    diff: str

    @property
    def title(self):
        before, after = (" ".join(text.split()) for text in (self.original, self.replaced))
        return f"{self.path}: {before} -> {after or '(nothing)'}"

    def mutant(self):
        programs, equivalent = PROGRAMS[self.folder], judged.equivalent().get(self.name, "")
        return Mutant(self.name, self.title, self.diff, programs, equivalent=equivalent, likely=likely(self.path, self.folder))


def likely(path, folder):
    """The tests that notice most of the mutants of patches/ that change this file; if there are none, of those that change its
    folder. To build what holds them takes a fraction of the time that the whole program takes."""
    usable = [made for made in _patches() if not made.sanitizer and set(made.programs) <= set(PROGRAMS[folder])]
    of_file = [made for made in usable if path in made.files]
    of_folder = [made for made in usable if any(file.startswith(f"{folder}/") for file in made.files)]
    counted = collections.Counter(test for made in of_file or of_folder for test in made.fails)
    return tuple(test for test, _ in counted.most_common(LIKELY))


@functools.cache
def _patches():
    return kept()


def diff_of(path, lines, first, original, replaced):
    """A unified diff that replaces the lines `original` from number `first` (from 0) on."""
    begin, end = max(0, first - CONTEXT), min(len(lines), first + len(original) + CONTEXT)
    added = len(replaced) - len(original)
    hunk = [f"--- a/{path}\n+++ b/{path}\n@@ -{begin + 1},{end - begin} +{begin + 1},{end - begin + added} @@\n"]
    hunk += [" " + line for line in lines[begin:first]]
    hunk += ["-" + line for line in original] + ["+" + line for line in replaced]
    return "".join(hunk + [" " + line for line in lines[first + len(original) : end]])


def candidates_of(source, types, folder):
    lines = source.text.splitlines(keepends=True)
    stem, seen, made = re.sub(r"\W", "_", source.path.rpartition(".")[0]), collections.Counter(), set()
    for kind in KINDS:
        for start, end, text in kind(source, types):
            if (start, end, text) in made:  # by another kind
                continue
            made.add((start, end, text))
            first, last = source.line_of(start), source.line_of(end - 1)
            begin, stop = source.line_starts[first], source.line_starts[last] + len(lines[last])
            original = source.text[begin:stop]
            changed = (source.text[begin:start] + text + source.text[end:stop]).splitlines(keepends=True)
            replaced = "".join(line for line in changed if line.strip() or line in original)
            # Of equal changes of equal lines, the second one has another name than the first.
            key = (source.path, original.strip(), replaced.strip())
            seen[key] += 1
            code = hashlib.sha256(repr((*key, seen[key])).encode()).hexdigest()[:8]
            diff = diff_of(source.path, lines, first, original.splitlines(True), replaced.splitlines(True))
            name = f"{stem}_{kind.__name__}_{code}"
            yield Candidate(name, folder, kind.__name__, source.path, first + 1, original, replaced, diff)


@functools.cache
def candidates(root=ROOT):
    """All mutants of the sources below `root`, by folder."""
    found = {}
    for folder in PROGRAMS:
        files = [path for path in sorted((root / folder).iterdir()) if path.suffix in (".h", ".cpp")]
        sources = [Source(path.relative_to(root).as_posix(), path.read_text()) for path in files]
        types = declared_types(sources)
        found[folder] = [candidate for source in sources for candidate in candidates_of(source, types, folder)]
    return found


def shares(lines, size):
    """How many mutants each folder gets: in proportion to its lines that compute, but at least 20, or an equal share of a
    smaller sample."""
    least = min(LEAST_OF_A_FOLDER, size // len(lines))
    rest = size - least * len(lines)
    beyond = {folder: rest * count // sum(lines.values()) for folder, count in lines.items()}
    largest = max(lines, key=lines.get)
    beyond[largest] += rest - sum(beyond.values())
    return {folder: least + beyond[folder] for folder in lines}


def sample(found, size=SAMPLE, seed=SEED):
    """`size` of these mutants by folder. In a folder the kinds take turns; no line is changed twice. Which mutant comes
    first is a hash of its name and the seed: a change of other lines does not change it. Raises ValueError if there are not so
    many."""
    count = sum(map(len, found.values()))
    if not 1 <= size <= count:
        raise ValueError(f"--sample {size}: there are {count} generated mutants")
    rank = functools.partial(_rank, seed)
    chosen = []
    lines_of = {folder: len({(c.path, c.line) for c in all_of_it}) for folder, all_of_it in found.items()}
    counts = shares(lines_of, size)
    for folder, all_of_it in found.items():
        by_kind = collections.defaultdict(list)
        for candidate in sorted(all_of_it, key=lambda c: rank(c.name), reverse=True):
            by_kind[candidate.kind].append(candidate)
        order, lines, taken = sorted(by_kind, key=lambda kind: rank(folder + kind)), set(), []
        while len(taken) < counts[folder] and any(by_kind.values()):
            for kind in order:
                while by_kind[kind]:
                    candidate = by_kind[kind].pop()
                    if (candidate.path, candidate.line) not in lines:
                        lines.add((candidate.path, candidate.line))
                        taken.append(candidate)
                        break
        chosen += taken[: counts[folder]]
    return chosen


def named(names):
    """The candidates of these names, in this order. Raises KeyError for an unknown name."""
    known = {candidate.name: candidate for candidate in every()}
    return [known[name] for name in names]


def every():
    return [candidate for folder in candidates().values() for candidate in folder]


def mutants(names=(), size=None, seed=None):
    """The mutants of these names, in this order, or those of a sample. Raises KeyError for an unknown name, ValueError for a
    sample that is larger than what there is."""
    chosen = named(names) if names else sample(candidates(), SAMPLE if size is None else size, SEED if seed is None else seed)
    return [candidate.mutant() for candidate in chosen]


def _rank(seed, name):
    return hashlib.sha256(f"{seed} {name}".encode()).digest()


def main():
    example = "Example: generate.py --sample 40 --seed 7"
    parser = argparse.ArgumentParser(description="Lists generated mutants.", epilog=example)
    parser.add_argument("--sample", type=int, default=SAMPLE, metavar="N", help="how many (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=SEED, metavar="S", help="each has its own sample (default: %(default)s)")
    parser.add_argument("--folder", choices=PROGRAMS, help="only of this folder")
    parser.add_argument("--kind", choices=[kind.__name__ for kind in KINDS], help="only of this kind")
    parser.add_argument("--list", action="store_true", help="all of them, not only a sample")
    parser.add_argument("--diff", metavar="NAME", help="print the change of this one, as git apply reads it")
    arguments = parser.parse_args()
    try:
        if arguments.diff:
            print(named([arguments.diff])[0].diff, end="")
            return
        chosen = every() if arguments.list else sample(candidates(), arguments.sample, arguments.seed)
    except KeyError:
        parser.error(f"there is no mutant {arguments.diff}: its line may have changed")
    except ValueError as wrong:
        parser.error(str(wrong))
    for c in chosen:
        if arguments.folder in (None, c.folder) and arguments.kind in (None, c.kind):
            print(f"{c.name}  {c.path}:{c.line}  {c.title.partition(': ')[2]}")


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:  # of a list into `head`
        sys.exit(0)
