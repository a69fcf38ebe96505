"""Ranges of batches. A task renders one aligned range of power-of-two size, as 64..128: its part then holds one block of the film."""

from typing import NamedTuple


class Range(NamedTuple):
    """The batches begin, begin + 1, ..., end - 1."""

    begin: int
    end: int

    @property
    def size(self):
        return self.end - self.begin

    def __str__(self):
        return f"{self.begin}..{self.end}"


def floor_power(number):
    """The largest power of two that is not above `number` >= 1."""
    return 1 << (int(number).bit_length() - 1)


def first_aligned(gap, most):
    """The largest aligned range at the beginning of `gap` with a power-of-two size of at most `most`."""
    size = min(floor_power(most), floor_power(gap.size))
    if gap.begin:
        size = min(size, gap.begin & -gap.begin)  # the lowest set bit
    return Range(gap.begin, gap.begin + size)


def missing(whole, there):
    """The gaps of `whole` that no range of `there` covers, in order."""
    gaps, begin = [], whole.begin
    for part in sorted(there):
        if part.begin > begin:
            gaps.append(Range(begin, min(part.begin, whole.end)))
        begin = max(begin, part.end)
        if begin >= whole.end:
            break
    if begin < whole.end:
        gaps.append(Range(begin, whole.end))
    return gaps


def without_overlap(whole, there):
    """Ranges of `there` that lie in `whole` and do not overlap, large ones first: what a merge can join."""
    kept = []
    for part in sorted(there, key=lambda part: (-part.size, part.begin)):
        inside = whole.begin <= part.begin and part.end <= whole.end
        if inside and all(part.end <= other.begin or other.end <= part.begin for other in kept):
            kept.append(part)
    return sorted(kept)


class Gaps:
    """The batches that no task has yet."""

    def __init__(self, gaps):
        self._gaps = [gap for gap in reversed(gaps) if gap.size]

    @property
    def batches(self):
        return sum(gap.size for gap in self._gaps)

    def take(self, most):
        """The next task's range, of at most `most` batches; None if all are taken."""
        if not self._gaps:
            return None
        gap = self._gaps.pop()
        taken = first_aligned(gap, most)
        if taken.end < gap.end:
            self._gaps.append(Range(taken.end, gap.end))
        return taken
