"""The picture that is to be made: its program, its tasks, and how the parts are joined."""

import dataclasses
import hashlib
import json
import pathlib
import subprocess
import zlib

import task
from ranges import Range

# Options that the farm gives itself, or whose files would not come back.
OURS = ("-o", "--output", "-s", "--samples", "--batch", "--batches", "--pilot", "--pilot-file", "--resume", "--watch", "--json",
        "--strategies", "--strategies-picture", "--keep-batches", "--folder", "--all", "--list", "--verify")  # fmt: skip


class JobError(Exception):
    """The job cannot be done; the text is one line."""


@dataclasses.dataclass
class Job:
    """`options`: further options of render or golden. `pilot`: batches of a golden's pilot. `program_there`: on the workers."""

    program: str
    scene: pathlib.Path
    samples: int
    batch: int = 4
    golden: bool = False
    pilot: int = 32
    options: list = dataclasses.field(default_factory=list)
    threads: int | None = None
    program_there: str = ""
    version: str = ""

    def check(self):
        """Raises JobError for what would fail in every task."""
        if not self.scene.is_file():
            raise JobError(f"{self.scene}: there is no such scene file")
        if self.samples % self.batch:
            raise JobError(f"--samples {self.samples} is not a whole number of batches of {self.batch} samples (--batch)")
        for option in self.options:
            name = "-" + option[1] if option[:1] == "-" and option[1:2] in ("o", "s") else option.partition("=")[0]
            if name in OURS:
                raise JobError(f"{name} among the options of the program: the farm gives or cannot use it")
        if self.golden and self.batches.size <= self.pilot:
            raise JobError(f"--samples {self.samples}: a golden needs more batches than the {self.pilot} of its pilot (--pilot)")
        try:
            self.version = task.version_of(self.program)
        except (OSError, subprocess.SubprocessError) as error:
            raise JobError(f"{self.program}: {getattr(error, 'strerror', None) or error}") from None
        if not self.version:
            raise JobError(f"{self.program} --version prints nothing: this is not the program")

    @property
    def batches(self):
        return Range(0, self.samples // self.batch)

    @property
    def phases(self):
        """Ranges of which each must be whole before the next begins: weights of a golden come from its pilot."""
        if not self.golden:
            return [self.batches]
        return [Range(0, self.pilot), Range(self.pilot, self.batches.end)]

    def identity(self):
        """What all parts of a folder must have in common. (Threads change no bit.)"""
        kept, words = [], iter(self.options)
        for word in words:
            if word in ("-t", "--threads"):
                next(words, None)
            elif not word.startswith(("-t", "--threads=", "-q", "--quiet")):
                kept.append(word)
        return {
            "scene": hashlib.sha256(self.scene.read_bytes()).hexdigest(),
            "kind": f"golden of {self.samples} samples, pilot of {self.pilot} batches" if self.golden else "render",
            "batch": self.batch,
            "options": kept,
            "version": self.version,
        }

    def task(self, batches, part, pilot=None):
        """The task of a range (task.py). `part`: its path in the shared folder; None: the files travel with the task."""
        arguments = ["golden" if self.golden else "render", "SCENE", "--batches", str(batches), "-o", "PART",
                     "--batch", str(self.batch), "-q", *self.options]  # fmt: skip
        files = {"SCENE": self.scene}
        if self.golden:
            arguments += ["--pilot", str(self.pilot), "-s", str(self.samples)]
            if batches.begin >= self.pilot:
                arguments += ["--pilot-file", "PILOT"]
                files["PILOT"] = pilot
        if self.threads and not any(word.startswith(("-t", "--threads")) for word in self.options):
            arguments += ["-t", str(self.threads)]
        if part:
            files = {word: str(path.resolve()) for word, path in files.items()}
        else:
            files = {word: (path.name, zlib.compress(path.read_bytes())) for word, path in files.items()}
        return {
            "program": self.program_there or self.program,
            "version": self.version,
            "arguments": arguments,
            "files": files,
            "part": str(part.resolve()) if part else None,
        }

    def merge(self, folder, names, outputs, samples=None, finish=False):
        """Joins the parts `names` of `folder`. Raises JobError with what the program says."""
        command = [self.program, "merge", "-q", *names]
        for output in outputs:
            command += ["-o", str(pathlib.Path(output).resolve())]
        command += (["-s", str(samples)] if samples else []) + (["--finish"] if finish else [])
        answer = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if answer.returncode:
            said = answer.stderr.strip().splitlines()
            raise JobError(said[-1] if said else f"plumbline merge ended with status {answer.returncode}")


def is_finished(job, path):
    """Whether a golden that is there is finished. Raises JobError if it is one that `plumbline golden` goes on with."""
    if not path.exists():
        return False
    answer = subprocess.run([job.program, "merge", "--check", path], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if answer.returncode == 0:
        raise JobError(f"{path}: is not finished: remove it, or let plumbline golden go on with it")
    return True


def same_identity(file, identity):
    """Writes the identity into a new file; the names of what differs from an old one."""
    if not file.is_file():
        file.write_text(json.dumps(identity, indent=1) + "\n")
        return []
    try:
        earlier = json.loads(file.read_text())
    except ValueError:
        return ["job.json, which is damaged"]
    return [name for name in identity if earlier.get(name) != identity[name]]
