"""Commands with a time limit, and their end: no process of a command outlives it."""

import os
import signal
import subprocess
import tempfile
import threading
import time
from typing import NamedTuple

GRACE = 3  # seconds between the request to end and the end by force


class Ended(NamedTuple):
    """`status`: the exit status, negative for a signal; None if the time limit ended it. `output`: both streams."""

    status: int | None
    output: str
    seconds: float


class Stopped(Exception):
    """The runner is to end (Ctrl-C)."""


_running: set[subprocess.Popen] = set()
_lock = threading.Lock()
_stopped = threading.Event()


def run(command, folder, seconds, environment=None, megabytes=0):
    """Runs a command in `folder`. `environment` is added to that of the runner; `megabytes` limits its memory (0: no limit):
    what a mutant does may have no end. A command may lift the limit for what it starts, as tests do for a browser. Raises Stopped after stop_all."""
    limits = "ulimit -c 0;" + (f" ulimit -S -v {megabytes * 1024};" if megabytes else "")
    begin = time.monotonic()
    with tempfile.TemporaryFile() as output:  # not a pipe: one that a grandchild keeps open would have no end
        with _lock:
            if _stopped.is_set():
                raise Stopped
            process = subprocess.Popen(
                ["sh", "-c", f'{limits} exec "$@"', "sh", *map(str, command)],
                cwd=folder,
                env=dict(os.environ, **(environment or {})),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            _running.add(process)
        try:
            status = process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            status = None
        finally:
            end_session(process)
            with _lock:
                _running.discard(process)
        if _stopped.is_set():
            raise Stopped
        output.seek(0)
        text = output.read(50_000_000).decode(errors="replace")
    return Ended(status, text, time.monotonic() - begin)


def stop_all():
    """Ends all commands that run, and lets none begin before allow()."""
    _stopped.set()
    with _lock:
        for process in _running:
            _signal_group(process.pid, signal.SIGTERM)


def allow():
    """Commands may begin again."""
    _stopped.clear()


def end_session(process):
    """Ends whatever is left of a command. The whole session: ninja gives each compiler a process group of its own."""
    if process.poll() is None:
        _signal_group(process.pid, signal.SIGTERM)
        try:
            process.wait(timeout=GRACE)
        except subprocess.TimeoutExpired:
            pass
    for pid in session(process.pid):
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    process.wait()


def _signal_group(group, number):
    try:
        os.killpg(group, number)
    except (ProcessLookupError, PermissionError):
        pass


def session(leader):
    """The processes of a session that live. (A dead leader's number is not given to another process while its session lives.)"""
    found = []
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            if os.getsid(int(name)) == leader:
                found.append(int(name))
        except (ProcessLookupError, PermissionError):
            pass
    return found
