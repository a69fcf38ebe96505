"""Renders all parts of a range on the workers of an engine: what is tried again, where, and when the job is given up.

The engine (engine.py; in tests a fake one) has these functions. Each may raise EngineLost.
  workers()             {worker: tasks that it runs at once}
  submit(task, allowed) begins a task on one of the workers `allowed`; the name of this attempt
  wait(seconds)         what has ended: [Event] (flight.py), after at most `seconds`
  where(attempt)        the worker that has it, or None if none has or its answer is on its way
  cancel(attempts)      their ends are of no interest any more
  connect()             after EngineLost
"""

import time

from blame import Blame
from connection import EngineLost, connect
from flight import Attempt, Flight
from job import JobError
from ranges import Gaps
from tries import Counts, Tries

TURN = 0.5  # seconds that a turn of the loop waits
SHARED_FOLDER_SECONDS = 5  # until a part that another machine wrote must be visible here


class Driver:
    """`open_engine`: begins the engine, when there is something to render."""

    def __init__(
        self, open_engine, job, parts, speed, progress, return_parts=False, patience=600.0, clock=time.monotonic, pause=time.sleep
    ):
        self.open_engine, self.job, self.parts, self.speed, self.progress = open_engine, job, parts, speed, progress
        self.engine = None
        self.return_parts, self.patience, self.clock, self.pause = return_parts, patience, clock, pause
        self.blame, self.counts = Blame(), Counts()
        self.flight = Flight()
        self.again = []  # ranges to be tried again
        self._tries = Tries()
        self._most_workers = 0
        self._busy = clock()  # when a task ran last

    def render(self, whole):
        """Returns when all parts of `whole` are there. Raises JobError."""
        self.gaps = Gaps(self.parts.missing(whole))
        if self.gaps.batches and self.engine is None:
            self.engine = self.open_engine()
        self._busy = self.clock()
        while self.gaps.batches or self.again or self.flight:
            try:
                self._turn()
            except EngineLost as lost:
                self._connect_again(lost)

    def close(self):
        if self.engine is not None:
            self.engine.close()

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
            if allowed := frozenset(usable) - self._tries.failed_at(batches):
                self._begin(batches, allowed)
            else:  # workers that are gone now may come back
                self._tries.expect_others(batches, self._most_workers)
                later.append(batches)
        self.again += later

    def _begin(self, batches, allowed):
        task = self.job.task(batches, None if self.return_parts else self.parts.path(batches), self.parts.pilot)
        attempt = self.engine.submit(task, allowed)
        self.flight[attempt] = Attempt(batches, allowed, self.clock())

    def _take_back_stranded(self, workers):
        """Attempts whose workers are all gone."""
        for name, attempt in self.flight.stranded(workers):
            self._forget([name])
            self._retry(attempt)

    def _copy_stragglers(self, usable):
        """At the end, idle workers get second copies of tasks that take too long. Both copies have the same bits."""
        if self.gaps.batches or self.again:
            return
        for name, attempt in self.flight.late(self.clock(), self.speed):
            if self.parts.path(attempt.batches).exists():  # its worker has stopped before it could say so
                self._forget([name])
                self.progress.rendered(attempt.batches.size)
            elif len(self.flight) < sum(usable.values()):
                where = self.engine.where(name)
                allowed = frozenset(usable) - {where} - self._tries.failed_at(attempt.batches)
                if allowed:
                    place = f"at {where}" if where else "and on its way"
                    seconds = self.clock() - attempt.begin
                    self.progress.say(f"batches {attempt.batches}: {seconds:.0f} s {place}; a second copy begins")
                    self.counts.copies += 1
                    self._begin(attempt.batches, allowed)

    def _forget(self, names):
        self.engine.cancel(names)
        for name in names:
            del self.flight[name]

    def _ended(self, event):
        attempt = self.flight.pop(event.attempt, None)
        if attempt is None:
            return
        react = {"done": self._done, "error": self._error, "foreign": self._foreign, "lost": self._lost}
        react[event.answer["kind"]](attempt, event)

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
        self._forget(self.flight.of(attempt.batches))

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
        self._tries.error(attempt.batches, event.worker, message)
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
        self._tries.lost(attempt.batches, event.answer["message"])
        self.progress.say(f"batches {attempt.batches}: {event.answer['message']}; again")
        self._retry(attempt)

    def _retry(self, attempt):
        if not self.flight.of(attempt.batches) and attempt.batches not in self.again:
            self.again.append(attempt.batches)

    def _last_error(self):
        failed = [batches for batches in self.again if self._tries.failed_at(batches)]
        return f"; {self._tries.describe(failed[0])}" if failed else ""

    def _connect_again(self, lost):
        self.progress.say(f"{lost}; connecting again for at most {self.patience:.0f} seconds")
        for attempt in self.flight.values():
            if attempt.batches not in self.again:
                self.again.append(attempt.batches)
        self.flight.clear()
        connect(self.engine, self.patience, self.clock, self.pause)
        self.counts.reconnections += 1
        self._busy = self.clock()
        self.progress.say(f"connected again; {len(self.again)} tasks are submitted again")
