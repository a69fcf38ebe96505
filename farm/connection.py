"""A scheduler that is lost, and connecting to it again."""

from job import JobError

LONGEST_PAUSE = 30.0  # seconds between two attempts


class EngineLost(Exception):
    """The engine does not answer. What it had begun is lost."""


def connect(engine, patience, clock, pause):
    """Tries for `patience` seconds, with pauses of 1, 2, 4, ... seconds. Raises JobError."""
    end, wait = clock() + patience, 1.0
    while True:
        try:
            return engine.connect()
        except EngineLost as still:
            if clock() + wait > end:
                raise JobError(f"{still}, for {patience:.0f} seconds") from None
        pause(wait)
        wait = min(2 * wait, LONGEST_PAUSE)
