"""Plumbline's fast path as a contestant: runs the program `plumbline render --device host`."""

import array
import json
import os
import subprocess
import sys

from blocks import block_means
from problem import Problem


class Plumbline:
    """Times are those of its --json: rendering alone, without start, reading the scene or building the tree."""

    def __init__(self, program, folder):
        self.program = program
        self.picture = os.path.join(folder, "plumbline.pfm")

    def version(self):
        return self.run(["--version"]).splitlines()[0]

    def run(self, arguments):
        try:
            done = subprocess.run([self.program, *arguments], capture_output=True, text=True, check=False,
                                  start_new_session=True)
        except OSError as error:
            raise Problem(f"{self.program}: {error.strerror}") from None
        if done.returncode != 0:
            raise Problem(f"{self.program}: {(done.stderr.strip() or 'failed').splitlines()[-1]}")
        return done.stdout

    def render(self, job, spp, seed, threads):
        arguments = ["render", job.scene_path, "-o", self.picture, "--device", "host", "--json", "--quiet",
                     "--no-roulette", "--size", f"{job.width}x{job.height}", "--integrator", job.integrator,
                     "--max-edges", str(job.max_edges), "-s", str(spp), "--seed", str(seed), "-t", str(threads)]
        report = json.loads(self.run(arguments + (["--frame"] if job.frame else [])))
        return {"samples": report["samples"], "seconds": report["seconds"], "cpu_seconds": report["cpu_seconds"],
                "means": block_means(read_pfm(self.picture), job.width, job.height, top_first=False)}

    def export(self, scene_path, frame, size, max_edges, folder):
        """The scene for Mitsuba, an .xml in the folder; paths of at most so many edges, without roulette."""
        name = os.path.splitext(os.path.basename(scene_path))[0]
        path = os.path.join(folder, name + ".xml")
        self.run(["export", scene_path, "-o", path, "-q", "--size", f"{size[0]}x{size[1]}",
                  "--max-edges", str(max_edges), *(["--frame"] if frame else [])])
        return path


def read_pfm(path):
    """The numbers of a PFM picture in colour, from the bottom row up."""
    with open(path, "rb") as file:
        kind, size, scale = (file.readline().strip() for _ in range(3))
        values = array.array("f", file.read())
    width, height = map(int, size.split())
    if kind != b"PF" or len(values) != 3 * width * height:
        raise Problem(f"{path}: not a PFM picture in colour")
    if (float(scale) < 0) != (sys.byteorder == "little"):
        values.byteswap()
    return values
