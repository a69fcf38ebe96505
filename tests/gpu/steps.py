"""The steps of the day: names, commands, time limits, and how the output of each is read."""
import shlex
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable, NamedTuple

import readings


class Command(NamedTuple):
    label: str
    words: list
    environment: dict = {}

    def __str__(self):
        settings = [f"{name}={value}" for name, value in self.environment.items()]
        return shlex.join(([*settings] if settings else []) + [str(word) for word in self.words])


@dataclass(frozen=True)
class Step:
    name: str
    what: str
    limit: int  # seconds
    commands: list
    read: Callable
    rounds: int = 1  # each command once per round, in an order drawn anew
    tool: str = ""  # skipped without this program of NVIDIA's
    prepare: list = field(default_factory=list)  # commands that are not measured

    @property
    def programs(self):
        """The programs of the build that the step runs, as words of its commands."""
        return {word for command in self.commands for word in command.words if isinstance(word, Path)}


SMALL_TESTS = ":".join(("OnDevice.ABuildCanBeCapturedInAGraph", "OnDevice.StagesTakeTimeAndGiveTheSameTree",
                        "OnDevice.RaysFindTheHitsThatTheHostFinds", "HplocOnDevice.IsTheSame",
                        "*.IsTheReferenceTreeOfItsCodesForEveryKindOfInput/device*"))
MUST = {"PLUMBLINE_REQUIRE_GPU": "1"}  # without a usable GPU, tests fail instead of being skipped
INTEGRATORS = ("path", "bdpt")
KERNELS = ("samples", "stages")  # a kernel for whole samples, or one for each stage (docs/stages.md)


def all_steps(build, scratch):
    """The steps for the programs of the folder `build`; pictures go to the folder `scratch`."""
    plumbline, test_cuda, test_renders = build / "plumbline", build / "tests/test_cuda", build / "tests/test_renders"
    test_extremes = build / "tests/test_extremes"

    def render(scene, integrator, kernels, size, samples, *more):
        return [plumbline, "render", f"scenes/{scene}.dae", "-o", f"{scratch}/picture.pfm", "--device", "cuda",
                "--kernels", kernels, "--integrator", integrator, "--max-edges", "6", "--size", size, "-s", str(samples), "-q", *more]

    def renders(scenes, size, samples):
        return [Command(f"{scene} {integrator} {kernels}", render(scene, integrator, kernels, size, samples, "--json"))
                for scene in scenes for integrator in INTEGRATORS for kernels in KERNELS]

    def tests(program, pattern):
        return [program, f"--gtest_filter={pattern}"]

    def bvh(scene, *more):
        return [plumbline, "bvh", scene, "-q", "--device", "cuda", *more]

    mesh = f"{scratch}/million.dae"
    make_mesh = Command("mesh", ["python3", "tests/gpu/mesh.py", "1000000", mesh])
    yield Step("gpu.driver", "the GPU and its driver, by nvidia-smi", 5, [Command("", [
        "nvidia-smi", "--query-gpu=name,driver_version,memory.total,clocks.max.sm,clocks.max.memory,power.limit",
        "--format=csv,noheader"])], readings.driver, tool="nvidia-smi")
    yield Step("gpu.device", "the GPU as plumbline describes it, after it ran an empty kernel", 15,
               [Command("", [plumbline, "--version"])], readings.device)
    yield Step("gpu.tools", "which of NVIDIA's tools are here", 5, [Command("", [
        "sh", "-c", 'for i in nvidia-smi compute-sanitizer ncu nvcc; do echo "$i $(command -v $i)"; done'])],
        readings.tools)

    yield Step("tests.cuda", "device tests: trees, rays, renderer, stages", 60,
               [Command("", tests(test_cuda, "*OnDevice.*:*/device*"), MUST)], readings.gtest)
    yield Step("tests.renders", "device renders of every scene against its golden", 85,
               [Command("", tests(test_renders, "*OnADeviceAllAgree*"), MUST)], readings.gtest)

    yield Step("tests.extremes", "the methods of plumbline extremes on the device: rays, pictures, trees, formulas", 10,
               [Command("", tests(test_extremes, "*OnDevice.*"), MUST)], readings.gtest)

    for check in ("memcheck", "racecheck", "initcheck", "synccheck"):
        under = ["compute-sanitizer", "--tool", check, "--error-exitcode", "9"]
        yield Step(f"sanitize.{check}.tests", f"a few device tests under {check}", 12,
                   [Command("", under + tests(test_cuda, SMALL_TESTS), MUST)], readings.sanitized_gtest,
                   tool="compute-sanitizer")
        yield Step(f"sanitize.{check}.renders", f"small renders under {check}", 14,
                   [Command(f"{i} {kernels}", under + render("cornell_glass", i, kernels, "16x12", 1))
                    for i in (*INTEGRATORS, "light") for kernels in KERNELS],
                   readings.sanitizer, tool="compute-sanitizer")

    yield Step("bench.trees", "builds of trees by stages: 20,498 triangles and a million", 35,
               [Command("mesh_knot", bvh("scenes/mesh_knot.dae", "--repeats", "20", "--json")),
                Command("million", bvh(mesh, "--repeats", "20", "--json"))],
               readings.trees, rounds=5, prepare=[make_mesh])
    yield Step("bench.renders", "renders of 240x160 pixels, 256 samples per pixel, by both kinds of kernels", 65,
               renders(("cornell_diffuse", "cornell_glass", "mesh_knot"), "240x160", 256), readings.render, rounds=5)
    # The report took 195 s (path) and 2,354 s (bdpt) for CBspheres_lambertian, 2,764 s (bdpt) for CBspheres. Its
    # scenes are not part of Plumbline.
    yield Step("bench.pictures", "the two pictures of the 2015 course report in size and samples (960x640, 256); "
               "cornell_diffuse and cornell_glass stand for its Cornell boxes with spheres", 105,
               renders(("cornell_diffuse", "cornell_glass"), "960x640", 256), readings.render, rounds=3)

    def ncu(kernels, skip, count):
        sections = [word for name in ("LaunchStats", "Occupancy", "SpeedOfLight") for word in ("--section", name)]
        return ["ncu", "--csv", "--page", "details", *sections, "--clock-control", "none",
                "--kernel-name-base", "demangled", "--kernel-name", f"regex:{kernels}",
                "--launch-skip", str(skip), "--launch-count", str(count)]

    yield Step("ncu.trees", "Nsight Compute on the kernels of a build over a million triangles", 20,
               [Command("", ncu("run_kernel|cub::", 0, 16) + bvh(mesh, "--repeats", "1"))], readings.ncu, tool="ncu",
               prepare=[make_mesh])
    for integrator in INTEGRATORS:  # the first launches are small: launches grow until they take 30 ms
        yield Step(f"ncu.{integrator}", f"Nsight Compute on two launches of the kernel of {integrator}, and on some of "
                   "its stages", 30,
                   [Command(kernels, ncu(pattern, skip, count) +
                            render("cornell_glass", integrator, kernels, "960x640", 32))
                    for kernels, pattern, skip, count in (
                        ("samples", "RenderSamples", 8, 2),
                        ("stages", "Generate|Extend|Shade|Connect|Test", 100, 12))],
                   readings.ncu, tool="ncu")
