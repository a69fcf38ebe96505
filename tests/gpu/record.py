"""The record of a run."""
import collections
import json
import os
import tempfile
import time

import readings


class Record:
    """The JSON file. It is replaced as a whole, so that a reader never sees half of it."""

    def __init__(self, path, steps, build):
        self.path = path
        self.start = time.monotonic()
        self.json = {"begun": time.strftime("%Y-%m-%dT%H:%M:%S%z"), "build": str(build), "seconds": 0.0, "counts": {},
                     "steps": [{"name": step.name, "what": step.what, "commands": [str(c) for c in step.commands],
                                "rounds": step.rounds, "limit_seconds": step.limit, "status": readings.SKIPPED,
                                "reason": "not reached", "seconds": 0.0, "numbers": {}} for step in steps]}
        if path is not None:
            path.parent.mkdir(parents=True, exist_ok=True)
            if path.exists():
                path.replace(path.with_name(path.name + ".previous"))

    def skip_all(self, reason):
        for step in self.json["steps"]:
            step["reason"] = reason

    def save(self):
        self.json["seconds"] = round(time.monotonic() - self.start, 3)
        self.json["counts"] = dict(collections.Counter(step["status"] for step in self.json["steps"]))
        if self.path is None:
            return
        with tempfile.NamedTemporaryFile("w", dir=self.path.parent, prefix=self.path.name, delete=False) as file:
            json.dump(self.json, file, indent=1)
            file.write("\n")
        os.chmod(file.name, 0o644)
        os.replace(file.name, self.path)
