"""Runs the commands of a step within a time limit."""
import os
import random
import signal
import subprocess
import tempfile
import time
from typing import NamedTuple

import readings

KEPT = 2000  # characters that the record keeps of the beginning of an output, and as many of its end


class Outcome(NamedTuple):
    code: int  # None: it was stopped at the limit
    out: str
    err: str
    seconds: float


def stop(process):
    """Ends a command and the processes that it started."""
    for sign, patience in ((signal.SIGTERM, 1), (signal.SIGKILL, 3)):
        try:
            os.killpg(process.pid, sign)
        except ProcessLookupError:
            pass
        try:
            process.wait(patience)
        except subprocess.TimeoutExpired:
            continue
        if sign == signal.SIGTERM:  # what it started may have ignored the first signal
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        return


def run(words, environment, limit, root):
    """Output goes to files: a pipe that a stopped command's children hold open would block."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        def read(file):
            file.seek(0)
            return file.read().decode(errors="replace")
        try:
            process = subprocess.Popen([str(word) for word in words], cwd=root, stdin=subprocess.DEVNULL, stdout=out,
                                       stderr=err, env={**os.environ, **environment}, start_new_session=True)
        except OSError as error:
            return Outcome(127, "", f"{words[0]}: {error.strerror}", 0.0)
        try:
            code = process.wait(max(limit, 0.01))
        except subprocess.TimeoutExpired:
            code = None
            stop(process)
        except BaseException:
            stop(process)
            raise
        return Outcome(code, read(out), read(err), time.monotonic() - start)


def shortened(text):
    return text if len(text) <= 2 * KEPT else f"{text[:KEPT]}\n...\n{text[-KEPT:]}"


def run_step(step, limit, root, record, save):
    """Runs a step and writes status, reason, numbers and seconds into its record, and saves after each command."""
    start = time.monotonic()
    record["status"], record["reason"] = readings.FAILED, "interrupted"
    save()
    for command in step.prepare:
        outcome = run(command.words, command.environment, limit, root)
        if outcome.code != 0:
            late = outcome.code is None
            record.update(status=readings.TIMED_OUT if late else readings.FAILED, seconds=outcome.seconds,
                          reason=f"{command} {'took too long' if late else 'failed: ' + outcome.err[-200:].strip()}")
            return
    measured = {command.label: [] for command in step.commands}
    worst = readings.Reading(readings.PASSED, "", {})
    severity = (readings.PASSED, readings.SKIPPED, readings.FAILED, readings.TIMED_OUT)
    for number in range(step.rounds):
        for command in random.sample(step.commands, len(step.commands)) if step.rounds > 1 else step.commands:
            outcome = run(command.words, command.environment, limit - (time.monotonic() - start), root)
            late = outcome.code is None
            reading = step.read(1 if late else outcome.code, outcome.out, outcome.err)
            if late:
                reading = reading._replace(status=readings.TIMED_OUT, reason=f"stopped after {limit:.0f} s" + (
                    f", in round {number + 1} of {step.rounds}" if step.rounds > 1 else ""))
            if not late or step.rounds == 1:  # half a measurement is none
                whole = {"process_seconds": round(outcome.seconds, 4)} if step.rounds > 1 else {}
                measured[command.label].append({**reading.numbers, **whole})
            if severity.index(reading.status) > severity.index(worst.status) or (
                    reading.status == readings.PASSED and reading.reason and not worst.reason):
                label = f"{command.label}: " if command.label else ""
                worst = reading._replace(reason=label + reading.reason if reading.reason else "")
                record["output"] = shortened(outcome.out + outcome.err)
            record["numbers"] = numbers_of(step, measured)
            record["seconds"] = round(time.monotonic() - start, 3)
            save()
            if late:
                break
        if worst.status == readings.TIMED_OUT:
            break
    record.update(status=worst.status, reason=worst.reason)


def numbers_of(step, measured):
    """By label, unless there is a single command without one."""
    found = {label: readings.over_rounds(rounds) if step.rounds > 1 else rounds[0]
             for label, rounds in measured.items() if rounds}
    return found.get("", found)
