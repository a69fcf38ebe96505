"""Files that are whole or not there, and the outcomes of mutants that were tried."""

import contextlib
import dataclasses
import enum
import fcntl
import json
import os
import threading


class Outcome(str, enum.Enum):
    KILLED = "killed"
    CRASH = "killed by a crash"
    TIMEOUT = "killed by time-out"
    SURVIVED = "SURVIVED"
    NO_BUILD = "does not build"
    NO_PATCH = "does not apply"

    @property
    def killed(self):
        return self in (Outcome.KILLED, Outcome.CRASH, Outcome.TIMEOUT)


    def by(self, test):
        """The outcome in words, with the test."""
        return self.value + (f" {'by' if self is Outcome.KILLED else 'in'} {test}" if test else "")


@dataclasses.dataclass
class Result:
    """`killed_by`: the first test that noticed the mutant, `killers`: all that did. `noticed_after`: seconds
    of builds and tests until the first of them. `weighed`: whether more
    tests were run than until it was noticed (trial.py, weigh_tests). `wrong`: what is
    not as the mutant's head says, in sentences. `detail`: the first lines of the compiler or of git."""

    name: str
    file: str
    title: str
    outcome: Outcome
    killed_by: str = ""
    build_seconds: float = 0.0
    test_seconds: float = 0.0
    wrong: list[str] = dataclasses.field(default_factory=list)
    detail: str = ""
    equivalent: str = ""
    weighed: bool = False
    noticed_after: float = 0.0
    killers: list[str] = dataclasses.field(default_factory=list)

    @property
    def fine(self):
        """Whether nothing has to be done about it."""
        expected = self.outcome is Outcome.SURVIVED if self.equivalent else self.outcome.killed
        return expected and not self.wrong


def write_whole(path, text):
    """Writes a file so that it has either its old or its new content."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        temporary.write_text(text)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


@contextlib.contextmanager
def alone(place):
    """While this runs, no other runner uses the copies below `place`. Raises RuntimeError if one does."""
    place.mkdir(parents=True, exist_ok=True)
    with (place / "lock").open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise RuntimeError(f"another runner uses {place}: wait for its end") from None
        yield  # the system removes the lock with the process


class Kept:
    """The results of earlier starts for the same sources: a file, one line of JSON for each result, appended as they come.
    Results for other sources go when the file is opened. `digests`: see sources.py."""

    def __init__(self, path, digests):
        self.path, self.digests, self.results, self._lock = path, digests, {}, threading.Lock()
        lines = []
        for line in path.read_text().splitlines() if path.is_file() else []:
            try:
                entry = json.loads(line)
                result = Result(**dict(entry["result"], outcome=Outcome(entry["result"]["outcome"])))
                current = entry["sources"] == digests.of_programs(entry["programs"])
            except (ValueError, KeyError, TypeError):
                continue  # the runner was ended while it wrote this line, or is newer
            if current:
                self.results[entry["mutant"], result.weighed] = result
                lines.append(line + "\n")
        write_whole(path, "".join(lines))

    def find(self, mutant, weighed):
        found = self.results.get((mutant.digest, weighed))
        return found and dataclasses.replace(found, name=mutant.name, title=mutant.title)

    def add(self, mutant, result):
        programs = list(mutant.programs)
        sources = self.digests.of_programs(programs)
        entry = {"mutant": mutant.digest, "programs": programs, "sources": sources, "result": dataclasses.asdict(result)}
        with self._lock:
            self.results[mutant.digest, result.weighed] = result
            with self.path.open("a") as file:
                file.write(json.dumps(entry) + "\n")
