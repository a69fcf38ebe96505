"""What has happened to the tasks: numbers for the last line, and the failures of each task."""

import collections
import dataclasses

from job import JobError

SAME_ERROR = 3  # workers that must say the same before it counts as the task's fault
LOSSES = 3  # times that a task may be lost with its workers (each time the engine itself has tried several)


@dataclasses.dataclass
class Counts:
    """What happened, for the last line and for the table of faults."""

    tasks: int = 0
    failed: int = 0
    lost: int = 0
    copies: int = 0
    reconnections: int = 0

    def __str__(self):
        more = (
            ("failed and tried again", self.failed),
            ("lost with their workers", self.lost),
            ("second copies", self.copies),
            ("connected again", self.reconnections),
        )
        return "; ".join([f"{self.tasks} tasks", *(f"{what}: {number}" for what, number in more if number)])


class Tries:
    """Failures by range of batches."""

    def __init__(self):
        self._errors = collections.defaultdict(dict)  # range: {worker: message}
        self._losses = collections.Counter()

    def failed_at(self, batches):
        """The workers that have failed this task."""
        return frozenset(self._errors.get(batches, ()))

    def error(self, batches, worker, message):
        """Raises JobError if enough workers have said this."""
        self._errors[batches][worker] = message
        if list(self._errors[batches].values()).count(message) >= SAME_ERROR:
            self.give_up(batches)

    def expect_others(self, batches, workers):
        """Raises JobError if the task has failed at all of so many workers, or at enough."""
        if len(self.failed_at(batches)) >= min(SAME_ERROR, workers):
            self.give_up(batches)

    def give_up(self, batches):
        raise JobError(self.describe(batches))

    def lost(self, batches, message):
        """Raises JobError if it was lost too often."""
        self._losses[batches] += 1
        if self._losses[batches] >= LOSSES:
            raise JobError(f"batches {batches}: worker after worker is lost with this task: {message}")

    def describe(self, batches):
        errors = self._errors[batches]
        return f"batches {batches}: {list(errors.values())[-1]} (at {len(errors)} worker{'s' if len(errors) > 1 else ''})"
