"""Are equal configurations found equal, on this machine? Runs `plumbline trade` many times on one configuration
under two names (--instructions best, and the name of the best), and counts how often the interval of the ratio
contains 1. With --load another process computes all the time. See docs/trade.md, section 3."""

import argparse
import json
import math
import statistics
import subprocess
import sys


def study(program, scene, truth, seed, seconds):
    """The interval of the ratio of speeds, and that of the times to equal noise."""
    names = ["avx512", "avx2", "baseline"]
    for name in names:
        command = [program, "trade", scene, "--truth", truth, "--seconds", str(seconds), "--seed", str(seed),
                   "--knobs", f"instructions=best,{name}", "--json", "-q"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stderr)
        value = json.loads(done.stdout)["knobs"][0]["values"][1]
        other = [c for c in json.loads(done.stdout)["configurations"] if c["name"] == value["configuration"]][0]
        if other["problem"] is None:
            return value["speed"], value["time_to_equal_noise"]
    sys.exit("no instruction set has a name")


def half_width(interval):
    return math.sqrt(interval["high"] / interval["low"]) - 1


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default="build/release/plumbline")
    parser.add_argument("--scene", default="scenes/cornell_diffuse.dae")
    parser.add_argument("--truth", default="golden/renders/cornell_diffuse.exr")
    parser.add_argument("--studies", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=2)
    parser.add_argument("--load", type=int, default=0, help="processes that compute beside")
    options = parser.parse_args()
    others = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(options.load)]
    try:
        found = [study(options.program, options.scene, options.truth, seed, options.seconds)
                 for seed in range(1, options.studies + 1)]
    finally:
        for other in others:
            other.kill()
    for what, intervals in zip(("speed", "time to equal noise"), zip(*found)):
        equal = sum(i["low"] <= 1 <= i["high"] for i in intervals)
        width = statistics.median(half_width(i) for i in intervals)
        print(f"{what}: equal in {equal} of {len(intervals)} studies, median half width {100 * width:.1f}%")


if __name__ == "__main__":
    main()
