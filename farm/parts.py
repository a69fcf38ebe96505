"""The folder of parts: which batches are there, whole. A part has its name only when it is whole."""

import fcntl
import os
import re
import subprocess
import uuid

from job import JobError, same_identity
from ranges import Range, missing, without_overlap

NAME = re.compile(r"batches_(\d+)-(\d+)\.exr")
PILOT = "pilot.exr"
CHECKED_AT_ONCE = 500  # parts in one command line


class Parts:
    """The parts of `job` in `folder`, which only one driver may use at a time. Raises JobError."""

    def __init__(self, folder, job):
        self.folder, self.job = folder, job
        folder.mkdir(parents=True, exist_ok=True)
        self._lock = (folder / ".lock").open("w")
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self.close()
            raise JobError(f"{folder}: another ./run farm uses these parts") from None
        if different := same_identity(folder / "job.json", job.identity()):
            self.close()
            raise JobError(f"{folder}: holds parts of another picture (other {', '.join(different)}): name another --parts")
        for left in folder.glob(".*.tmp-*"):  # of workers that are gone
            left.unlink(missing_ok=True)

    def close(self):
        self._lock.close()

    def path(self, batches):
        return self.folder / f"batches_{batches.begin:08}-{batches.end:08}.exr"

    @property
    def pilot(self):
        return self.folder / PILOT

    def names(self, whole):
        """{range: file name}: parts within `whole` that do not overlap."""
        there = {}
        for path in self.folder.iterdir():
            if found := NAME.fullmatch(path.name):
                there[Range(int(found[1]), int(found[2]))] = path.name
        return {part: there[part] for part in without_overlap(whole, there)}

    def missing(self, whole):
        return missing(whole, list(self.names(whole)))

    def write(self, batches, content):
        """Writes a part that came back through the engine."""
        path = self.path(batches)
        temporary = path.with_name(f".driver-{uuid.uuid4().hex[:12]}.tmp-{path.name}")
        try:
            with temporary.open("wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)

    def remove_damaged(self, whole):
        """Removes the parts that are damaged or hold other batches than their names say. What was wrong with each, in one line."""
        names = list(self.names(whole).values())
        wrong = []
        for at in range(0, len(names), CHECKED_AT_ONCE):
            some = names[at : at + CHECKED_AT_ONCE]
            command = [self.job.program, "merge", "--check", *some]
            answer = subprocess.run(command, cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
            said = {name: line for line in answer.stdout.splitlines() for name, colon, _ in [line.partition(":")] if colon}
            if answer.returncode not in (0, 1) or set(some) - set(said):
                raise JobError(f"plumbline merge --check: {(answer.stderr.strip().splitlines() or ['says nothing'])[-1]}")
            for name in some:
                found = NAME.fullmatch(name)
                if said[name] != f"{name}: batches {int(found[1])}..{int(found[2])}":
                    (self.folder / name).unlink(missing_ok=True)
                    wrong.append(said[name])
        return wrong

    def remove_all(self):
        for path in [*self.folder.glob("batches_*.exr"), self.pilot, self.folder / "job.json", self.folder / ".lock"]:
            path.unlink(missing_ok=True)
        try:
            self.folder.rmdir()
        except OSError:  # what others have put there stays
            pass
