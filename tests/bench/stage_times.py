"""Profile by stage of the fast path on the host, and the vector width that each stage reaches.

    python3 tests/bench/stage_times.py [--folder FOLDER] [--rounds N] [--integrator path|bdpt] SCENE.dae

Runs stage_times_baseline, _avx2 and _avx512 of FOLDER in random order within each round. Prints a Markdown table: by
stage, its share of the time with avx512, nanoseconds per index with the baseline instructions, and how many times as
fast avx2 and avx512 are, with 95% intervals over the rounds. The lanes are 8 and 16.
"""

import argparse
import json
import random
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "peers"))
from statistics_of_ratios import ratio_of  # noqa: E402

SETS = ("baseline", "avx2", "avx512")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folder", default="build/release/tests")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--integrator", choices=("path", "bdpt"), default="path")
    parser.add_argument("scene")
    options = parser.parse_args()
    order = random.Random(1)
    runs = {name: [] for name in SETS}
    for _ in range(options.rounds):
        for name in order.sample(SETS, len(SETS)):
            command = [f"{options.folder}/stage_times_{name}", options.scene, options.integrator]
            runs[name].append(json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout))
    best = runs[SETS[-1]]
    whole = sum(stage["seconds"] for run in best for stage in run.values())
    print("| stage | share of the time, avx512 | baseline, ns per index | avx2 / baseline | avx512 / baseline |")
    print("|---|---|---|---|---|")
    for stage in sorted(best[0], key=lambda name: -sum(run[name]["seconds"] for run in best)):
        rates = {name: [run[stage]["indices"] / run[stage]["seconds"] for run in runs[name]] for name in SETS}
        share = sum(run[stage]["seconds"] for run in best) / whole
        cells = [f"`{stage}`", f"{100 * share:.0f}%", f"{1e9 * options.rounds / sum(rates['baseline']):.0f}"]
        for name in SETS[1:]:
            ratio = ratio_of(rates[name], rates[SETS[0]])
            cells.append(f"{ratio.value:.1f} [{ratio.low:.1f}, {ratio.high:.1f}]")
        print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
