"""The options of ./run peers."""

import argparse
import os
import sys

OURS = ("cornell_diffuse", "cornell_glass", "mesh_knot")
COURSE = ("CBspheres_lambertian", "CBspheres", "CBbunny", "CBcoil")
PEERS = ("mitsuba", "luxcore", "embree")


def names_of(allowed):
    def parse(text):
        names = text.split(",")
        for name in names:
            if name not in allowed:
                raise argparse.ArgumentTypeError(f"{name}: not one of {', '.join(allowed)}")
        return names
    return parse


def positive(kind):
    def parse(text):
        try:
            value = kind(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text}: not a number") from None
        if not 0 < value < 1e6:
            raise argparse.ArgumentTypeError(f"{text}: not a positive number")
        return value
    return parse


def threads_of(text):
    return sorted({positive(int)(each) for each in text.split(",")})


def size_of(text):
    width, _, height = text.partition("x")
    return positive(int)(width), positive(int)(height)


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog="./run peers", description="Measures Plumbline's fast path beside other renderers. See docs/peers.md.")
    parser.add_argument("--rounds", type=positive(int), default=7, help="rounds, each with every renderer [7]")
    parser.add_argument("--seconds", type=positive(float), default=1.0, help="of one run, about [1]")
    parser.add_argument("--scenes", type=names_of(OURS + COURSE), default=[*OURS, *COURSE],
                        help="names with commas between them [all]")
    parser.add_argument("--only", type=names_of(PEERS), default=[*PEERS], help="mitsuba, luxcore, embree [all]")
    parser.add_argument("--threads", type=threads_of, default=[1, 2], help="numbers of threads [1,2]")
    parser.add_argument("--size", type=size_of, default=(240, 160), help="of the pictures [240x160]")
    parser.add_argument("--pictures", type=int, default=32,
                        help="pictures of each renderer that are compared first; 0: none, and no verdict [32]")
    parser.add_argument("--picture-seconds", type=positive(float), default=0.25, help="of one of these [0.25]")
    parser.add_argument("--repetitions", type=positive(int), default=7, help="of builds and rays beside Embree [7]")
    parser.add_argument("--seed", type=int, default=1, help="of the order and of the pictures [1]")
    parser.add_argument("--output", default="out/peers.json", help="[out/peers.json]")
    parser.add_argument("--plumbline", default=os.environ.get("PLUMBLINE", "build/release/plumbline"),
                        help="the program [$PLUMBLINE, or build/release/plumbline]")
    parser.add_argument("--bench", default=os.environ.get("PLUMBLINE_BENCH_FAST", "build/release/tests/bench_fast"),
                        help="the benchmark [$PLUMBLINE_BENCH_FAST, or build/release/tests/bench_fast]")
    parser.add_argument("--python", default="build/peers/venv/bin/python", help="Python with the peers' packages")
    options = parser.parse_args(arguments)
    if options.pictures == 1 or options.pictures < 0:
        parser.error("--pictures: 0, or at least 2")
    return options


if __name__ == "__main__":  # checks the options
    parse(sys.argv[1:])
