"""Calibration, the comparison of pictures, and the rounds."""

import functools
import random
import sys
import time

from contestants import PAIRS
from problem import Problem
from statistics_of_ratios import compare_means

LARGEST_SPP = 256  # memory of Mitsuba's LLVM backend, which holds all samples of a render at once
CALIBRATION_SPP = 4


class Progress:
    """One line on standard error: rewritten on a terminal, otherwise a new one every half minute."""

    def __init__(self, total_seconds):
        self.start = time.monotonic()
        self.total = total_seconds
        self.shown = 0.0

    def show(self, share, what):
        now = time.monotonic()
        terminal = sys.stderr.isatty()
        if now - self.shown < (0.5 if terminal else 30) and share < 1:
            return
        self.shown = now
        elapsed = now - self.start
        # Early on, the time that was planned is a better guess than what a few runs took.
        left = max(self.total * (1 - share) if share < 0.05 else 0.0, elapsed * (1 - share) / max(share, 1e-3))
        line = f"{100 * share:3.0f}%, {left / 60:.1f} minutes left: {what}"
        print(f"\r\033[K{line}" if terminal else line, end="" if terminal else "\n", file=sys.stderr, flush=True)


class Entry:
    """One contestant on one scene: the number of samples of a run, the runs, the pictures that are compared."""

    def __init__(self, contestant):
        self.contestant = contestant
        self.spp = {}  # by threads
        self.runs = {}  # by threads: by round
        self.pictures = []
        self.failure = None

    @property
    def key(self):
        return self.contestant.scene, self.contestant.name

    def rate(self, threads, round_number, clock):
        """Samples per second of the clock, "seconds" or "cpu_seconds"."""
        run = self.runs[threads][round_number]
        return run["samples"] / run[clock]


def spp_for(run, seconds, pixels):
    spp = round(run["samples"] / run["seconds"] * seconds / pixels)
    return min(max(spp // CALIBRATION_SPP * CALIBRATION_SPP, CALIBRATION_SPP), LARGEST_SPP)


def calibrate(entry, threads, seconds, pixels):
    """The first launch compiles kernels; the second one is timed."""
    for count in threads:
        for _ in range(2):
            run = entry.contestant.render(CALIBRATION_SPP, 0, count)
        entry.spp[count] = spp_for(run, seconds, pixels)


def render_pictures(entry, count, threads, pixels, seconds, first_seed):
    """Pictures with seeds of their own, of about so many seconds each."""
    run = entry.contestant.render(CALIBRATION_SPP, first_seed, threads)
    spp = spp_for(run, seconds, pixels)
    entry.pictures = [entry.contestant.render(spp, first_seed + 1 + i, threads)["means"] for i in range(count)]


def compare_pictures(entries):
    """Differences by scene and pair. Plumbline's picture is the first of the two."""
    differences = {}
    by_key = {entry.key: entry for entry in entries if entry.pictures}
    for scene in dict.fromkeys(entry.contestant.scene for entry in entries):
        for ours, theirs in PAIRS:
            if (scene, ours) in by_key and (scene, theirs) in by_key:
                differences[scene, ours, theirs] = compare_means(by_key[scene, ours].pictures,
                                                                 by_key[scene, theirs].pictures)
    return differences


def attempt(entry, action):
    """Runs it; a failure is reported at once, and the entry is measured no more."""
    try:
        action()
    except Problem as problem:
        entry.failure = str(problem)
        print(f"\n{entry.contestant.scene}: {problem}", file=sys.stderr)


def prepare_one(entry, options, pixels, seed):
    calibrate(entry, options.threads, options.seconds, pixels)
    if options.pictures:
        render_pictures(entry, options.pictures, max(options.threads), pixels, options.picture_seconds, seed)


def prepare(entries, options, pixels):
    """Calibrates, and renders the pictures that are compared."""
    progress = Progress(len(entries) * (3 + options.pictures * options.picture_seconds))
    for number, entry in enumerate(entries):
        progress.show((number + 0.01) / len(entries), f"pictures of {' '.join(entry.key)}")
        # Seeds far from those of the rounds, and different ones for each contestant of a scene.
        seed = 100000 + 1000 * number
        attempt(entry, functools.partial(prepare_one, entry, options, pixels, seed))


def run_once(entry, threads, number):
    run = entry.contestant.render(entry.spp[threads], 1 + number, threads)
    entry.runs.setdefault(threads, {})[number] = run


def measure_rounds(entries, options):
    """Scenes in random order, and within a scene all contestants and numbers of threads in random order, so that
    the runs that form a ratio are close to each other in time, and neither is always the first."""
    order = random.Random(options.seed)
    scene_names = list(dict.fromkeys(entry.contestant.scene for entry in entries))
    total = len(entries) * len(options.threads) * options.rounds
    progress = Progress(total * options.seconds)
    done = 0
    for number in range(options.rounds):
        for scene in order.sample(scene_names, len(scene_names)):
            tasks = [(entry, threads) for entry in entries if entry.contestant.scene == scene
                     for threads in options.threads]
            for entry, threads in order.sample(tasks, len(tasks)):
                progress.show((done + 0.01) / total, f"round {number + 1} of {options.rounds}, {scene}")
                done += 1
                if entry.failure is None:
                    attempt(entry, functools.partial(run_once, entry, threads, number))
    progress.show(1.0, "done")
    if sys.stderr.isatty():
        print(file=sys.stderr)
