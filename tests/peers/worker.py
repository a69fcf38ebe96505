"""The side of a peer: a program that loads a renderer and obeys commands, one JSON object a line, on standard
input. Each answer is one JSON object on the original standard output. Whatever the renderer's library prints goes
to standard error, which is a log file: import this module before the library, which may print when imported."""

import json
import os
import resource
import sys
import traceback

ANSWERS = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def cpu_seconds():
    """Of this process, all threads."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def serve(commands):
    """`commands`: functions by name, which take the members of the object as arguments and return an object."""
    for line in sys.stdin:
        request = json.loads(line)
        try:
            answer = commands[request.pop("do")](**request)
        except Exception as error:  # the other side reports it in one line; the log has the rest
            traceback.print_exc()
            answer = {"error": f"{type(error).__name__}: {error}".splitlines()[0]}
        print(json.dumps(answer), file=ANSWERS, flush=True)
    sys.stdout.flush()
    os._exit(0)  # the destructors of some libraries crash at the end of the interpreter
