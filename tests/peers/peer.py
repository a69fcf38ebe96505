"""The side of the script: a worker process, started when first asked."""

import json
import os
import select
import subprocess

from problem import Problem

HERE = os.path.dirname(os.path.abspath(__file__))


class Peer:
    def __init__(self, name, python, program, arguments, log_folder, environment=None):
        self.name = name
        self.command = [python, os.path.join(HERE, program), *arguments]
        self.log_path = os.path.join(log_folder, name + ".log")
        self.environment = {**os.environ, **(environment or {})}
        self.process = None

    def ask(self, limit=300, **request):
        """The answer to one command. Raises Problem if the worker fails or takes longer than `limit` seconds."""
        if self.process is None:
            with open(self.log_path, "w", encoding="utf-8") as log:
                # A session of its own: Ctrl-C is for the script, which then stops the workers.
                self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log,
                                                text=True, env=self.environment, start_new_session=True)
        try:
            self.process.stdin.write(json.dumps(request) + "\n")
            self.process.stdin.flush()
            ready, _, _ = select.select([self.process.stdout], [], [], limit)
            line = self.process.stdout.readline() if ready else ""
        except BrokenPipeError:
            line = ""
        if not line:
            self.stop()
            raise Problem(f"{self.name}: {self.last_words()}")
        try:
            answer = json.loads(line)
        except ValueError:
            raise Problem(f"{self.name}: its answer is not JSON: {line.strip()[:60]}") from None
        if "error" in answer:
            raise Problem(f"{self.name}: {answer['error']} (see {self.log_path})")
        return answer

    def last_words(self):
        """Of a worker that ended or hangs."""
        with open(self.log_path, encoding="utf-8", errors="replace") as log:
            lines = log.read().split("\n")
        return next((line.strip() for line in reversed(lines) if line.strip()), "no answer")

    def stop(self):
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process = None
