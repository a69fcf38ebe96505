"""What the runner says while it works: one line for each mutant, and on a terminal what remains."""

import time


class Progress:
    """`waiting`: how many mutants are still to be tried; `all_of_them`: with those whose result is known."""

    def __init__(self, waiting, all_of_them, width, out, status):
        self.waiting, self.all, self.width, self.out = waiting, all_of_them, width, out
        self.status = status if status.isatty() else None
        self.done, self.begin = all_of_them - waiting, time.monotonic()

    def say(self, text):
        """What happens now: a line that the next one replaces on a terminal, and a line as any other elsewhere."""
        if self.status:
            self._status(text)
        else:
            print(text, file=self.out, flush=True)

    def result(self, result):
        self.done += 1
        self._status("")
        print(line(result, self.width), file=self.out, flush=True)
        for sentence in result.wrong:
            print(f"  WRONG: {sentence}", file=self.out, flush=True)
        for text in result.detail.splitlines():
            print(f"  {text}", file=self.out, flush=True)
        self._status(f"{self.done} of {self.all}; {self.remaining()}")

    def remaining(self):
        tried = self.done - (self.all - self.waiting)
        if tried == 0:
            return ""
        seconds = (time.monotonic() - self.begin) / tried * (self.all - self.done)
        return f"about {seconds / 60:.0f} minutes left" if seconds >= 90 else f"about {seconds:.0f} seconds left"

    def end(self):
        self._status("")

    def _status(self, text):
        if self.status:
            print(f"\r\033[K{text}", end="", file=self.status, flush=True)


def line(result, width):
    times = f"build {result.build_seconds:.1f} s, tests {result.test_seconds:.1f} s"
    more = ", by this test alone" if result.weighed and len(result.killers) == 1 else ""
    judged = " (equivalent)" if result.equivalent else ""
    return f"{result.name:{width}}  {result.outcome.by(result.killed_by)}{more}{judged}  ({times})"
