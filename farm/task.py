"""What a worker does: runs the program once, for one range of batches. This file travels to the workers: standard library only.

A task is a dictionary:
  program    the program on the worker
  version    what its --version must print in the first line
  arguments  with the words SCENE, PILOT and PART in place of files
  files      SCENE and PILOT: a path, or (name, bytes of zlib) to be written into a folder of the worker
  part       the part's path in the shared folder, or None: its bytes are returned
The answer is a dictionary too: `kind` is "done", "error" (of the program, in `message`), or "foreign" (another version, in `message`).
"""

import os
import shutil
import socket
import subprocess
import tempfile
import time
import uuid
import zlib

LOOK_SECONDS = 2  # between looks whether another worker has made the part


def run(task):
    begin = time.monotonic()
    try:
        version = version_of(task["program"])
        if version != task["version"]:
            return {"kind": "foreign", "message": version}
        with tempfile.TemporaryDirectory(prefix="plumbline-farm-") as folder:
            answer = _render(task, folder)
    except OSError as error:
        answer = {"kind": "error", "message": _one_line(f"{error.strerror or error}: {error.filename or task['program']}")}
    return dict(answer, seconds=time.monotonic() - begin)


def version_of(program):
    """The first line of --version. (The second tells of a GPU, which is a matter of the machine.)"""
    answer = subprocess.run([program, "--version"], stdin=subprocess.DEVNULL, capture_output=True, timeout=60)
    return answer.stdout.decode(errors="replace").partition("\n")[0].strip()


def _render(task, folder):
    paths = {word: _place(file, folder) for word, file in task["files"].items()}
    final = task["part"]
    if final and os.path.exists(final):
        return {"kind": "done"}
    temporary = os.path.join(folder, "part.exr")
    if final:
        where, name = os.path.split(final)
        temporary = os.path.join(where, f".{socket.gethostname()}-{uuid.uuid4().hex[:12]}.tmp-{name}")
    paths["PART"] = temporary
    try:
        status, message = _program([task["program"], *(paths.get(word, word) for word in task["arguments"])], final)
        if status is None:  # another worker was faster
            return {"kind": "done"}
        if status != 0:
            said = message.replace(temporary, final or "the part") or f"the program ended with status {status}"
            return {"kind": "error", "message": _one_line(said)}
        if final:
            os.replace(temporary, final)
            return {"kind": "done"}
        with open(temporary, "rb") as file:
            return {"kind": "done", "bytes": file.read()}
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)


def _place(file, folder):
    if isinstance(file, str):
        return file
    name, content = file
    path = os.path.join(folder, os.path.basename(name))
    with open(path, "wb") as out:
        out.write(zlib.decompress(content))
    return path


def _program(command, final):
    """(exit status, standard error). The status is None if `final` appeared meanwhile. The program ends with the worker, and a
    Ctrl-C at the worker's terminal is not for it."""
    if setpriv := shutil.which("setpriv"):
        command = [setpriv, "--pdeathsig", "TERM", *command]
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True
    ) as process:
        while True:
            try:
                said = process.communicate(timeout=LOOK_SECONDS)[1]
                return process.returncode, said.decode(errors="replace")
            except subprocess.TimeoutExpired:
                if final and os.path.exists(final):
                    process.terminate()
                    process.communicate()
                    return None, ""


def _one_line(text):
    """The last line of what a program said: the error. (Notices stand above it.)"""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else ""
