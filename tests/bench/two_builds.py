"""What a change costs: two builds of Plumbline render the same pictures, one after the other.

    python3 tests/bench/two_builds.py BEFORE AFTER [--rounds N] [--instructions] [SCENE.dae ...]

BEFORE and AFTER are two programs `plumbline`, compiled with the same options. Prints a Markdown table: for each scene
and implementation (`--device ref`, `--device host`) the ratio of the user CPU times, AFTER over BEFORE, with its 95%
interval over the rounds; the order within each round is random. Needs a quiet machine. With --instructions, the
instructions that each executes on a small picture instead, counted by valgrind: exact, and valid under any load.
The exit status is 1 if a whole interval, or the ratio of instructions, is above --limit.
"""

import argparse
import random
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "peers"))
from statistics_of_ratios import ratio_of  # noqa: E402

DEVICES = ("ref", "host")
SCENES = ("scenes/cornell_diffuse.dae", "scenes/cornell_glass.dae", "scenes/mesh_knot.dae")


def command(program, scene, device, size, samples, output):
    return [program, "render", scene, "-o", output, "--device", device, "--size", size, "-s", str(samples), "-t", "1",
            "--seed", "1", "-q"]


def user_seconds(arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(arguments, check=True, capture_output=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def instructions(arguments):
    with tempfile.NamedTemporaryFile() as log:
        subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", f"--log-file={log.name}",
                        *arguments], check=True, capture_output=True)
        found = re.search(r"Collected : (\d+)", Path(log.name).read_text(encoding="utf-8"))
    return int(found.group(1))


def check(programs):
    """Equal programs would compare a program with itself."""
    for program in programs:
        if not Path(program).is_file():
            sys.exit(f"two_builds.py: {program}: no such file")
    if Path(programs[0]).read_bytes() == Path(programs[1]).read_bytes():
        sys.exit("two_builds.py: both programs are the same file")


def row(scene, device, cells):
    print("|", " | ".join([Path(scene).stem, device, *cells]), "|", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("scenes", nargs="*", default=SCENES)
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--size", default="120x80")
    parser.add_argument("--instructions", action="store_true")
    parser.add_argument("--limit", type=float, default=1.01)
    options = parser.parse_args()
    programs = (options.before, options.after)
    check(programs)
    order = random.Random(1)
    exceeded = False
    if options.instructions:
        print("| scene | device | before | after | ratio |\n|---|---|---|---|---|")
    else:
        print("| scene | device | seconds before | after / before | interval |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes:
            for device in DEVICES:
                def arguments(program, samples=options.samples, size=options.size, scene=scene, device=device):
                    return command(program, scene, device, size, samples, f"{folder}/picture.exr")
                if options.instructions:
                    before, after = (instructions(arguments(program, 8, "60x40")) for program in programs)
                    row(scene, device, [f"{before:,}", f"{after:,}", f"{after / before:.5f}"])
                    exceeded |= after / before > options.limit
                    continue
                seconds = {program: [] for program in programs}
                for _ in range(options.rounds):
                    for program in order.sample(programs, 2):
                        seconds[program].append(user_seconds(arguments(program)))
                ratio = ratio_of(seconds[options.after], seconds[options.before])
                row(scene, device, [f"{sum(seconds[options.before]) / options.rounds:.2f}", f"{ratio.value:.4f}",
                                    f"{ratio.low:.4f} to {ratio.high:.4f}"])
                exceeded |= ratio.low > options.limit
    return 1 if exceeded else 0


if __name__ == "__main__":
    sys.exit(main())
