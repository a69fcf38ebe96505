"""An engine without processes: workers that a test makes fail, stop, or vanish, and a clock that only the test moves."""

import itertools

from connection import EngineLost
from flight import Event


class Worker:
    """`seconds`: for each batch. `fails`: the message of every task, or a function of the range. `vanishes`: after so many tasks."""

    def __init__(self, seconds=1.0, fails=None, stopped=False, version="fake 1.0", vanishes=None):
        self.seconds, self.fails, self.stopped, self.version, self.vanishes = seconds, fails, stopped, version, vanishes
        self.begun = []  # the parts of its tasks


class FakeEngine:
    """Calls in the order of driver.py; a task writes its part when its time has come."""

    def __init__(self, workers, write):
        self.all, self.write, self.time = workers, write, 0.0
        self.numbers = itertools.count()
        self.running = {}  # attempt: (worker, end, task)
        self.queue, self.ended, self.cancelled, self.allowed = [], [], [], []
        self.break_at, self.broken_for, self.lost = None, 0, False

    def clock(self):
        return self.time

    def pause(self, seconds):
        self.time += seconds

    def connect(self):
        if self.broken_for > 0:
            self.broken_for -= 1
            raise EngineLost("no scheduler")
        self.lost = False
        self.running, self.queue, self.ended = {}, [], []

    def workers(self):
        if self.lost:
            raise EngineLost("the scheduler is lost")
        return {name: 1 for name in self.all}

    def submit(self, task, allowed):
        number = next(self.numbers)
        self.allowed.append(allowed)
        self.queue.append((number, task, allowed))
        self._start()
        return number

    def _start(self):
        for item in list(self.queue):
            number, task, allowed = item
            busy = {worker for worker, _, _ in self.running.values()}
            free = [name for name in sorted(allowed) if name in self.all and name not in busy]
            if free:
                name, worker = free[0], self.all[free[0]]
                worker.begun.append(task["part"])
                first, _, last = task["arguments"][3].partition("..")
                seconds = worker.seconds * (int(last) - int(first))
                end = float("inf") if worker.stopped else self.time + (0.1 if worker.fails else seconds)
                self.running[number] = (name, end, task)
                self.queue.remove(item)

    def wait(self, seconds):
        if self.break_at is not None and self.time >= self.break_at:
            self.break_at, self.lost = None, True
            raise EngineLost("the scheduler is lost")
        self.time += seconds
        if self.time > 5000:
            raise AssertionError("the driver comes to no end")
        events = []
        for number, (name, end, task) in sorted(self.running.items(), key=lambda item: item[1][1]):
            if end > self.time or name not in self.all:
                continue
            del self.running[number]
            events.append(self._end(number, name, task))
        self._start()
        return events

    def _end(self, number, name, task):
        worker = self.all[name]
        if worker.vanishes is not None:
            worker.vanishes -= 1
            if worker.vanishes < 0:
                del self.all[name]
                return Event(number, None, {"kind": "lost", "message": f"lost with {name}"})
        if worker.version != task["version"]:
            return Event(number, name, {"kind": "foreign", "message": worker.version})
        message = worker.fails(task) if callable(worker.fails) else worker.fails
        if message:
            return Event(number, name, {"kind": "error", "message": message})
        first, _, last = task["arguments"][3].partition("..")
        answer = {"kind": "done", "seconds": worker.seconds * (int(last) - int(first))}
        content = self.write(task)
        return Event(number, name, answer if content is None else dict(answer, bytes=content))

    def where(self, attempt):
        return self.running[attempt][0] if attempt in self.running else None

    def cancel(self, attempts):
        for attempt in attempts:
            self.cancelled.append(attempt)
            self.running.pop(attempt, None)
            self.queue = [item for item in self.queue if item[0] != attempt]

    def close(self):
        self.closed = True
