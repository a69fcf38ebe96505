"""How long tasks take, and how many batches the next one is given."""

import statistics

from ranges import floor_power

REMEMBERED = 101  # tasks
TASKS_PER_WORKER = 16  # about; more make more parts, which the merge must read, and each has the size of the picture


class Speed:
    """`task_seconds`: what a task should take, at least. `task_batches`: a fixed size in its place, a power of two. `all_batches`: of
    the job; in a long one, tasks are longer."""

    def __init__(self, task_seconds=60.0, task_batches=None, all_batches=0):
        self.task_seconds, self.task_batches, self.all_batches = task_seconds, task_batches, all_batches
        self._largest, self._costs = 0, []  # seconds per batch, of tasks of about the largest size

    def add(self, batches, seconds):
        """A task has taken this long. Small first tasks are dominated by the start of the program: larger ones replace them."""
        if batches < self._largest / 2:
            return
        if batches > 2 * self._largest:
            self._costs = []
        self._largest = max(self._largest, batches)
        self._costs = [*self._costs, max(seconds, 1e-6) / batches][-REMEMBERED:]

    @property
    def seconds_per_batch(self):
        """The median; None before the first task has ended."""
        return statistics.median(self._costs) if self._costs else None

    def expected(self, batches):
        """Seconds that a task of this size should take, or None."""
        return None if not self._costs else self.seconds_per_batch * batches

    def batches(self, remaining, slots):
        """The size of the next task. The last tasks are smaller, down to an eighth: the workers then end at about the same time."""
        if self.task_batches:
            return self.task_batches
        if not self._costs:
            return 1
        wanted = max(self.task_seconds / self.seconds_per_batch, self.all_batches / (TASKS_PER_WORKER * max(slots, 1)))
        wanted = min(wanted, max(wanted / 8, remaining / (2 * max(slots, 1))))
        # A first task of one batch may have measured little more than a start: grow by at most 16 times at once.
        return floor_power(max(1, min(wanted, 16 * self._largest)))
