"""Rates of the fast path on the host for each instruction set, in rounds.

    python3 tests/peers/instruction_sets.py [--plumbline FILE] [--rounds N] [--threads N] [--integrator I] SCENE...

Prints a Markdown table: thousand samples per second of CPU time with the baseline instructions, and the ratio to it
with avx2 and avx512, as mean and 95% interval over the rounds. Names of scenes are those of scenes/, or files, which
are framed. The order within a round is random, from a fixed seed.
"""

import argparse
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from statistics_of_ratios import ratio_of  # noqa: E402

SETS = ("baseline", "avx2", "avx512")
PIXELS = ("--size", "240x160")


def rate(options, scene, instructions, samples, output):
    """Thousand samples per second of CPU time, for one thread; of elapsed time, for several."""
    framed = scene.endswith(".dae")
    file = scene if framed else f"scenes/{scene}.dae"
    command = [options.plumbline, "render", file, *(["--frame"] if framed else []), "-o", output, "--device", "host",
               "--instructions", instructions, "--integrator", options.integrator, "--max-edges", "6", "--no-roulette",
               *PIXELS, "-s", str(samples), "-t", str(options.threads), "-q", "--json"]
    report = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    seconds = report["cpu_seconds"] if options.threads == 1 else report["seconds"]
    return report["samples"] / seconds / 1000


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--plumbline", default="build/release/plumbline")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--integrator", default="path")
    parser.add_argument("--samples", type=int, default=32, help="per pixel")
    parser.add_argument("scenes", nargs="+")
    options = parser.parse_args()
    order = random.Random(1)
    print("| scene | " + " | ".join([SETS[0] + ", thousand samples/s", *(f"{s} / {SETS[0]}" for s in SETS[1:])]) + " |")
    print("|---" * (len(SETS) + 1) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes:
            rates = {name: [] for name in SETS}
            for _ in range(options.rounds):
                for name in order.sample(SETS, len(SETS)):
                    rates[name].append(rate(options, scene, name, options.samples, f"{folder}/out.exr"))
            base = rates[SETS[0]]
            cells = [f"{sum(base) / len(base):.0f}"]
            for name in SETS[1:]:
                ratio = ratio_of(rates[name], base)
                cells.append(f"{ratio.value:.2f} [{ratio.low:.2f}, {ratio.high:.2f}]")
            print(f"| {Path(scene).stem} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
