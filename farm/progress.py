"""What the driver says: what goes wrong, a line each; on a terminal what remains, else that now and then."""

import time

SECONDS_BETWEEN_LINES = 60  # where standard error is no terminal


class Progress:
    """`done` and `all` count batches; `done` at the beginning are those of an earlier start."""

    def __init__(self, done, all_of_them, out, quiet=False, clock=time.monotonic):
        self.done, self.all, self.out, self.quiet, self.clock = done, all_of_them, out, quiet, clock
        self.terminal = out.isatty()
        self._known, self._begin, self._said = done, clock(), None
        self._line = ""

    def say(self, text):
        """An event, which stays."""
        if self.terminal:
            print("\r\033[K", end="", file=self.out)
        print(text, file=self.out, flush=True)
        self._show()

    def rendered(self, batches):
        self.done += batches

    def state(self, workers, tasks):
        """Called often."""
        self._line = f"{self.done} of {self.all} batches; {tasks} tasks, {workers} workers{self.remaining()}"
        if self.terminal:
            self._show()
        elif not self.quiet and (self._said is None or self.clock() - self._said >= SECONDS_BETWEEN_LINES):
            self._said = self.clock()
            print(self._line, file=self.out, flush=True)

    def remaining(self):
        made = self.done - self._known
        if not made:
            return ""
        seconds = (self.clock() - self._begin) / made * (self.all - self.done)
        if seconds >= 5400:
            return f"; about {seconds / 3600:.1f} hours left"
        return f"; about {seconds / 60:.0f} minutes left" if seconds >= 90 else f"; about {seconds:.0f} seconds left"

    def end(self):
        self._line = ""
        if self.terminal:
            print("\r\033[K", end="", file=self.out, flush=True)

    def _show(self):
        if self.terminal and not self.quiet:
            print(f"\r\033[K{self._line}", end="", file=self.out, flush=True)
