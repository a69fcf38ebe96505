"""Renders all parts of a range on the workers of an engine: what is tried again, where, and when the job is given up.

The engine (engine.py; in tests a fake one) has these functions. Each may raise EngineLost.
  workers()             {worker: tasks that it runs at once}
  submit(task, allowed) begins a task on one of the workers `allowed` (None: any); the name of this attempt
  wait(seconds)         what has ended: [Event], after at most `seconds`
  where(attempt)        the worker that has it, or None
  cancel(attempts)      their ends are of no interest any more
  connect()             after EngineLost
"""

import dataclasses
import time
from typing import NamedTuple

from blame import Blame
from job import JobError
from ranges import Gaps, Range

SAME_ERROR = 3  # workers that must say the same before it counts as the task's fault
LOSSES = 3  # times that a task may be lost with its workers (each time the engine itself has tried several)
SLOW = 4  # a task that takes this many times the expected time is a straggler
SLOW_SECONDS = 5  # at least
TURN = 0.5  # seconds that a turn of the loop waits
SHARED_FOLDER_SECONDS = 5  # until a part that another machine wrote must be visible here


class EngineLost(Exception):
    """The engine does not answer. What it had begun is lost."""


class Event(NamedTuple):
    """The end of an attempt. `answer`: as task.py; or {"kind": "lost", "message": why}."""

    attempt: object
    worker: str | None
    answer: dict


@dataclasses.dataclass
class Attempt:
    batches: Range
    allowed: frozenset
    begin: float
    copy: bool = False


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
            (self.failed, "failed and tried again"),
            (self.lost, "lost with their workers"),
            (self.copies, "second copies"),
            (self.reconnections, "times connected again"),
        )
        return ", ".join([f"{self.tasks} tasks", *(f"{number} {what}" for number, what in more if number)])


class Driver:
    def __init__(self, engine, job, parts, speed, progress, return_parts=False, patience=600.0, clock=time.monotonic, pause=time.sleep):
        self.engine, self.job, self.parts, self.speed, self.progress = engine, job, parts, speed, progress
        self.return_parts, self.patience, self.clock, self.pause = return_parts, patience, clock, pause
        self.blame, self.counts = Blame(), Counts()
        self.flight = {}  # attempts that run
        self.again = []  # ranges to be tried again
        self._errors = {}  # range: {worker: message}
        self._losses = {}
        self._most_workers = 0
        self._busy = clock()  # when a task ran last

    def render(self, whole):
        """Returns when all parts of `whole` are there. Raises JobError."""
        self.gaps = Gaps(self.parts.missing(whole))
        self._busy = self.clock()
        while self.gaps.batches or self.again or self.flight:
            try:
                self._turn()
            except EngineLost as lost:
                self._connect_again(lost)

    def _turn(self):
        workers = self.engine.workers()
        usable = self.blame.usable(workers)
        self._most_workers = max(self._most_workers, len(usable))
        self._take_back_stranded(workers)
        self._submit(usable)
        self._copy_stragglers(usable)
        if self.flight:
            self._busy = self.clock()
        elif workers and not usable:
            raise JobError(f"no worker has this version of the program ({self.job.version})")
        elif self.clock() - self._busy > self.patience:
            raise JobError(f"no worker for {self.patience:.0f} seconds" + self._last_error())
        self.progress.state(len(usable), len(self.flight))
        for event in self.engine.wait(TURN):
            self._ended(event)

    def _submit(self, usable):
        slots = sum(usable.values())
        later = []
        while len(self.flight) < slots + max(1, slots // 4) and usable:  # a few more than run, so that no worker waits
            batches = self.again.pop(0) if self.again else self.gaps.take(self.speed.batches(self.gaps.batches, slots))
            if batches is None:
                break
            if self.parts.path(batches).exists():  # of an attempt that was lost
                self.progress.rendered(batches.size)
                continue
            failed = self._errors.get(batches, {})
            allowed = frozenset(usable) - failed.keys()
            if allowed:
                self._begin(batches, allowed)
            elif len(failed) >= min(SAME_ERROR, self._most_workers):
                raise JobError(self._errors_of(batches))
            else:  # workers that are gone now may come back
                later.append(batches)
        self.again += later

    def _begin(self, batches, allowed, copy=False):
        task = self.job.task(batches, None if self.return_parts else self.parts.path(batches), self.parts.pilot)
        attempt = self.engine.submit(task, allowed)
        self.flight[attempt] = Attempt(batches, allowed, self.clock(), copy)

    def _take_back_stranded(self, workers):
        """Attempts whose workers are all gone."""
        for name, attempt in list(self.flight.items()):
            if not attempt.allowed & workers.keys():
                self.engine.cancel([name])
                del self.flight[name]
                self._retry(attempt)

    def _copy_stragglers(self, usable):
        """At the end, idle workers get second copies of tasks that take too long. Both copies have the same bits."""
        idle = sum(usable.values()) - len(self.flight)
        if self.gaps.batches or self.again or idle <= 0:
            return
        for name, attempt in list(self.flight.items()):
            expected = self.speed.expected(attempt.batches.size)
            seconds = self.clock() - attempt.begin
            if expected is None or seconds < max(SLOW * expected, SLOW_SECONDS) or len(self._copies(attempt.batches)) > 1:
                continue
            where = self.engine.where(name)
            allowed = frozenset(usable) - {where} - self._errors.get(attempt.batches, {}).keys()
            if where and allowed and idle > 0:
                idle -= 1
                self.counts.copies += 1
                self.progress.say(f"batches {attempt.batches}: {seconds:.0f} s at {where}; a second copy begins elsewhere")
                self._begin(attempt.batches, allowed, copy=True)

    def _copies(self, batches):
        return [name for name, attempt in self.flight.items() if attempt.batches == batches]

    def _ended(self, event):
        attempt = self.flight.pop(event.attempt, None)
        if attempt is None:
            return
        {"done": self._done, "error": self._error, "foreign": self._foreign, "lost": self._lost}[event.answer["kind"]](attempt, event)

    def _done(self, attempt, event):
        if (content := event.answer.get("bytes")) is not None:
            try:
                self.parts.write(attempt.batches, content)
            except OSError as error:
                raise JobError(f"{error.filename or self.parts.folder}: {error.strerror}") from None
        elif not self._visible(self.parts.path(attempt.batches)):
            message = f"the part of batches {attempt.batches} is not in {self.parts.folder}: is it shared? (else: --return-parts)"
            return self._error(attempt, event._replace(answer={"kind": "error", "message": message}))
        self.blame.succeeded(event.worker)
        self.counts.tasks += 1
        self.speed.add(attempt.batches.size, event.answer["seconds"])
        self.progress.rendered(attempt.batches.size)
        copies = self._copies(attempt.batches)
        self.engine.cancel(copies)
        for name in copies:
            del self.flight[name]

    def _visible(self, path):
        end = self.clock() + SHARED_FOLDER_SECONDS
        while not path.exists():
            if self.clock() > end:
                return False
            self.pause(TURN)
        return True

    def _error(self, attempt, event):
        self.counts.failed += 1
        message = event.answer["message"]
        errors = self._errors.setdefault(attempt.batches, {})
        errors[event.worker] = message
        if list(errors.values()).count(message) >= SAME_ERROR:
            raise JobError(self._errors_of(attempt.batches))
        self.progress.say(f"batches {attempt.batches}: failed at {event.worker}: {message}")
        if self.blame.failed(event.worker):
            self.progress.say(f"{event.worker}: failed several tasks in a row, and gets no more while others succeed")
        self._retry(attempt)

    def _foreign(self, attempt, event):
        if event.worker not in self.blame.foreign:
            self.blame.foreign.add(event.worker)
            has = event.answer["message"] or "no program that knows --version"
            self.progress.say(f"{event.worker}: is not used: it has {has}, not {self.job.version}")
        self._retry(attempt)

    def _lost(self, attempt, event):
        self.counts.lost += 1
        losses = self._losses[attempt.batches] = self._losses.get(attempt.batches, 0) + 1
        if losses >= LOSSES:
            raise JobError(f"batches {attempt.batches}: worker after worker is lost with this task: {event.answer['message']}")
        self.progress.say(f"batches {attempt.batches}: {event.answer['message']}; again")
        self._retry(attempt)

    def _retry(self, attempt):
        if not self._copies(attempt.batches) and attempt.batches not in self.again:
            self.again.append(attempt.batches)

    def _errors_of(self, batches):
        errors = self._errors[batches]
        return f"batches {batches}: {list(errors.values())[-1]} (at {len(errors)} worker{'s' if len(errors) > 1 else ''})"

    def _last_error(self):
        waiting = [batches for batches in self.again if batches in self._errors]
        return f"; {self._errors_of(waiting[0])}" if waiting else ""

    def _connect_again(self, lost):
        self.progress.say(f"{lost}; connecting again for at most {self.patience:.0f} seconds")
        for attempt in self.flight.values():
            if attempt.batches not in self.again:
                self.again.append(attempt.batches)
        self.flight.clear()
        end, wait = self.clock() + self.patience, 1.0
        while True:
            try:
                self.engine.connect()
                break
            except EngineLost as still:
                if self.clock() + wait > end:
                    raise JobError(f"{still}, for {self.patience:.0f} seconds") from None
            self.pause(wait)
            wait = min(2 * wait, 30.0)
        self.counts.reconnections += 1
        self._busy = self.clock()
        self.progress.say(f"connected again; {len(self.again)} tasks are submitted again")
