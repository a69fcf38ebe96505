"""A site on this machine: a Dask scheduler and workers as processes, and a driver beside them. Each can be killed, stopped, or put behind
a network that loses packets."""

import datetime
import os
import pathlib
import signal
import socket
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/mutants"))

from machine import processor  # noqa: E402
from processes import end_session, session  # noqa: E402

PYTHON = ROOT / "build/farm/venv/bin/python"


class Site:
    """`folder`: for logs. `inside`: a command that runs another one somewhere else, as `ip netns exec NAME`."""

    def __init__(self, folder, address="127.0.0.1", inside=()):
        self.folder, self.address, self.inside = folder, address, list(inside)
        folder.mkdir(parents=True, exist_ok=True)
        with socket.socket() as free:
            free.bind(("", 0))
            self.port = free.getsockname()[1]
        self.workers, self.scheduler = [], None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in [*self.workers, self.scheduler]:
            if process:
                end_session(process)

    @property
    def url(self):
        return f"tcp://{self.address}:{self.port}"

    def start_scheduler(self):
        command = [ROOT / "farm/scheduler.sh", "--host", self.address, "--port", str(self.port)]
        self.scheduler = self._start([*self.inside, *command], "scheduler")

    def kill_scheduler(self):
        end_session(self.scheduler)

    def start_worker(self, inside=()):
        number = len(self.workers)
        command = [ROOT / "farm/worker.sh", self.url, "--name", f"worker{number}", "--local-directory", self.folder / f"worker{number}"]
        self.workers.append(self._start([*inside, *command], f"worker{number}"))

    def signal_worker(self, number, which):
        """To the Python process of a worker."""
        for pid in session(self.workers[number].pid):
            if "dask" in _command(pid) and "worker.sh" not in _command(pid):
                os.kill(pid, which)

    def kill_worker(self, number):
        """All of a worker at once, as if its machine lost its power."""
        for pid in session(self.workers[number].pid):
            os.kill(pid, signal.SIGKILL)

    def driver(self, arguments, name="driver"):
        """Starts ./run farm's driver."""
        farm = [PYTHON, "-B", ROOT / "farm/farm.py", *arguments]
        return self._start([*self.inside, *farm], name)

    def said(self, name="driver"):
        return (self.folder / f"{name}.log").read_text()

    def _start(self, command, name):
        with (self.folder / f"{name}.log").open("a") as log:
            return subprocess.Popen(
                list(map(str, command)), stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True, cwd=ROOT
            )


def _command(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
    except OSError:
        return ""


def machine():
    """The machine and the day of a measurement, in words."""
    return f"{processor()}, {datetime.date.today().isoformat()}"


def parts_there(folder):
    return len(list(folder.glob("batches_*.exr"))) if folder.is_dir() else 0


def wait_until(condition, seconds, what):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            sys.exit(f"faults: waited {seconds} seconds for {what}")
        time.sleep(0.2)
