"""Which workers are not used: those that fail task after task while others succeed, and those with another program."""

import collections

IN_A_ROW = 3  # failed tasks after which a worker is used no more


class Blame:
    def __init__(self):
        self.foreign = set()
        self._streak = collections.Counter()

    def failed(self, worker):
        """Whether this failure is the one after which the worker is not used."""
        self._streak[worker] += 1
        return self._streak[worker] == IN_A_ROW

    def succeeded(self, worker):
        self._streak[worker] = 0

    def usable(self, workers):
        """Those of `workers` (a dictionary) that get tasks. If all of them fail, the fault is not theirs: all are used."""
        same = {worker: slots for worker, slots in workers.items() if worker not in self.foreign}
        good = {worker: slots for worker, slots in same.items() if self._streak[worker] < IN_A_ROW}
        return good or same
