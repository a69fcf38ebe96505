"""The attempts that run: which are late, and which have no worker any more."""

import dataclasses
from typing import NamedTuple

from ranges import Range

SLOW = 4  # a task that takes this many times the expected time is a straggler
SLOW_SECONDS = 5  # at least


@dataclasses.dataclass
class Attempt:
    """`allowed`: the workers that may have it. `begin`: when it was submitted."""

    batches: Range
    allowed: frozenset
    begin: float


class Event(NamedTuple):
    """The end of an attempt. `answer`: as task.py; or {"kind": "lost", "message": why}."""

    attempt: object
    worker: str | None
    answer: dict


class Flight(dict):
    """{name of the engine: Attempt}"""

    def of(self, batches):
        """The attempts at this range: two if it has a second copy."""
        return [name for name, attempt in self.items() if attempt.batches == batches]

    def late(self, now, speed):
        """Stragglers without a second copy, as (name, attempt)."""
        found = []
        for name, attempt in self.items():
            expected = speed.expected(attempt.batches.size)
            if expected is None or len(self.of(attempt.batches)) > 1:
                continue
            if now - attempt.begin >= max(SLOW * expected, SLOW_SECONDS):
                found.append((name, attempt))
        return found

    def stranded(self, workers):
        """Attempts whose workers are all gone."""
        return [(name, attempt) for name, attempt in self.items() if not attempt.allowed & workers.keys()]
