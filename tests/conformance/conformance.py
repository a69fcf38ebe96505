"""Exports Plumbline's scenes, renders them with Mitsuba 3 and LuxCore, and lets `plumbline compare` judge the pictures.
./run conformance makes the virtual environment and calls this."""

import argparse
import datetime
import glob
import json
import os
import statistics
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.append(os.path.join(ROOT, "tests", "peers"))

from contestants import libllvm
from luxcore_settings import NEVER
from machine import processor
from plumbline import read_pfm
from problem import Problem

from lifted import lifted
from page import write_page
from renderers import MAX_EDGES, RENDERERS, Peers

# Of a golden that is not one of golden/renders/.
GOLDEN_SAMPLES = 1024
REQUIRED = 0.005  # of compare: a visible error of the whole picture
LIFTED = 0.05
FIRST_PICTURES = 16  # as check-renderer


def options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", help="names, separated by commas [all in scenes/]")
    parser.add_argument("--renderers", default=",".join(RENDERERS), help=f"of {', '.join(RENDERERS)} [all]")
    parser.add_argument("--pictures", type=int, default=64, help="at most, of each scene, with different seeds [64]")
    parser.add_argument("--keep", action="store_true", help="take the pictures of an earlier run, if made in the same way")
    parser.add_argument("--variant", help="of Mitsuba [llvm_ad_rgb if there is an LLVM for it, or scalar_rgb]")
    parser.add_argument("--seed", type=int, default=1, help="of the first picture [1]")
    parser.add_argument("--page", help="write the tables into this page, between its marks: docs/results/conformance.md")
    return parser.parse_args()


def main():
    given = options()
    folder = os.path.join(ROOT, "out", "conformance")
    os.makedirs(folder, exist_ok=True)
    program = os.environ.get("PLUMBLINE", os.path.join(ROOT, "build", "release", "plumbline"))
    names = given.scenes.split(",") if given.scenes else sorted(
        os.path.splitext(os.path.basename(path))[0] for path in glob.glob(os.path.join(ROOT, "scenes", "*.dae")))
    for name in names:
        if not os.path.exists(os.path.join(ROOT, "scenes", name + ".dae")):
            raise Problem(f"no such scene: {name}")
    for name in given.renderers.split(","):
        if name not in RENDERERS:
            raise Problem(f"no such renderer: {name} (those there are: {', '.join(RENDERERS)})")
    if given.pictures < 2:
        raise Problem("--pictures: at least 2, because their noise is measured")
    llvm = os.environ.get("DRJIT_LIBLLVM_PATH") or libllvm() or ""
    variant = given.variant or ("llvm_ad_rgb" if llvm else "scalar_rgb")
    python = os.path.join(ROOT, "build", "peers", "venv", "bin", "python")
    peers = Peers(python, variant, llvm, folder)
    results = {"date": f"{datetime.date.today():%-d %B %Y}", "processor": processor(), "renderers": {}}
    try:
        exported = {name: export(name, program, folder) for name in names}
        for name in given.renderers.split(","):
            results["renderers"][name] = judge_renderer(RENDERERS[name], exported, program, peers, folder, given)
        measured_here = {} if given.scenes else {"roulette": roulette(exported["camera_in_glass"]["path"], peers, folder),
                                                 "lifted": lifted_lights(program, peers, folder, given)}
    finally:
        peers.stop()
    with open(os.path.join(folder, "conformance.json"), "w", encoding="utf-8") as file:
        json.dump(results, file, indent=1)
    if given.page:
        if not given.scenes:
            results["explained"] = {**explanations(python, folder, variant, llvm), **measured_here}
        write_page(given.page, results)
        if not given.scenes:
            draw_sheet(python, folder, os.path.join(ROOT, "docs", "images", "conformance.png"))
    return 0


def measured(python, script, *arguments, environment=None):
    """The standard output of a script that needs the virtual environment."""
    ran = subprocess.run([python, "-B", os.path.join(HERE, script), *arguments], capture_output=True, text=True,
                         env={**os.environ, **(environment or {})})
    if ran.returncode != 0:
        raise Problem(f"{script}: {(ran.stderr.strip() or 'no answer').splitlines()[-1]}")
    return ran.stdout


def explanations(python, folder, variant, llvm):
    """What explain.py measures."""
    return json.loads(measured(python, "explain.py", folder, variant, environment={"DRJIT_LIBLLVM_PATH": llvm}))


def roulette(path, peers, folder, pictures=16, walk=8):
    """The mean of the picture of LuxCore's bidirectional engine, by the depth at which its roulette begins."""
    rows = []
    place = os.path.join(folder, "roulette")
    os.makedirs(place, exist_ok=True)
    for depth in (NEVER, 3, 1):
        files = peers.by_name["luxcore"].ask(limit=3600, do="render", path=path, spp=64, seeds=list(range(pictures)),
                                             folder=place, integrator="BIDIRCPU", max_edges=walk,
                                             roulette=depth)["files"]
        pixels = [read_pfm(file)[0::3] for file in files]
        means = [sum(red) / len(red) for red in pixels]
        rows.append({"depth": None if depth == NEVER else depth, "mean": statistics.mean(means),
                     "error": statistics.stdev(means) / pictures**0.5})
    return rows


def lifted_lights(program, peers, folder, given):
    """The verdicts on flush_lights with its lights at a distance from the panel, beside a golden of our own."""
    place = os.path.join(folder, "lifted")
    os.makedirs(place, exist_ok=True)
    with open(os.path.join(ROOT, "scenes", "flush_lights.dae"), encoding="utf-8") as file:
        text = lifted(file.read(), LIFTED)
    scene = os.path.join(place, "lifted.dae")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(text)
    exported = export("lifted", program, folder, scene)["path"]
    rows = []
    for name in ("mitsuba", "luxcore"):
        found = judge("lifted", exported, RENDERERS[name], program, peers, folder, given, golden_of(scene, MAX_EDGES, program, folder))
        rows.append({**found, "renderer": name, "distance": LIFTED})
    return rows


def draw_sheet(python, folder, path):
    measured(python, "sheet.py", folder, os.path.join(ROOT, "golden", "renders"), path)


def export(name, program, folder, scene=None):
    """The scene for Mitsuba, which LuxCore's is made from: its path, or why there is none. `scene`: if it is none of ours."""
    scene = scene or os.path.join(ROOT, "scenes", name + ".dae")
    xml = os.path.join(folder, name, name + ".xml")
    os.makedirs(os.path.dirname(xml), exist_ok=True)
    ran = subprocess.run([program, "export", scene, "-q", "-o", xml, "--size", "64x64",
                          "--max-edges", str(MAX_EDGES)], capture_output=True, text=True)
    if ran.returncode != 0:
        return {"reason": ran.stderr.strip().removeprefix("plumbline: ").removeprefix(name + ": ")}
    return {"path": xml}


def judge_renderer(renderer, exported, program, peers, folder, given):
    """The verdicts on all scenes."""
    found = {"version": peers.version(renderer), "scenes": []}
    for name, scene in exported.items():
        if renderer.scenes is not None and name not in renderer.scenes:
            continue
        start = time.time()
        if "reason" in scene:
            result = {"scene": name, "verdict": "not exported", "reason": scene["reason"]}
        else:
            golden = os.path.join(ROOT, "golden", "renders", name + ".exr")
            if renderer.golden_edges is not None:
                golden = golden_of(os.path.join(ROOT, "scenes", name + ".dae"), renderer.golden_edges, program, folder)
            result = judge(name, scene["path"], renderer, program, peers, folder, given, golden)
        found["scenes"].append(result)
        print(f"{renderer.name}: {name}: {result['verdict']}: {result['reason']} ({time.time() - start:.0f} s)", flush=True)
    return found


def judge(name, path, renderer, program, peers, folder, given, golden):
    """The verdict on the pictures of one scene: on a few, and on more as long as these are too few to decide."""
    count = min(FIRST_PICTURES, given.pictures)
    while True:
        seeds = range(given.seed, given.seed + count)
        files, made = peers.render(renderer, name, path, seeds, os.path.join(folder, name, renderer.name),
                                   given.keep or count > FIRST_PICTURES)
        verdict = compare(program, files, golden, "--report", os.path.join(folder, f"{name}_{renderer.name}.html"))
        # Where the golden's own noise hides more than compare requires, more pictures change nothing.
        hidden = max((each for each in verdict["golden_limit"] if each is not None), default=0.0)
        if verdict["verdict"] != "INCONCLUSIVE" or count == given.pictures or hidden > REQUIRED:
            break
        count = min(2 * count, given.pictures)
    kept = ("verdict", "reason", "p", "coverage", "detectable", "summary", "whole")
    return {"scene": name, **made, **{key: verdict[key] for key in kept}}


def compare(program, files, golden, *more):
    """What `plumbline compare` says of these pictures."""
    ran = subprocess.run([program, "compare", *files, golden, "-q", "--json", *more], capture_output=True, text=True)
    if not ran.stdout:
        raise Problem(f"{os.path.basename(golden)}: {ran.stderr.strip()}")
    return json.loads(ran.stdout)


def golden_of(scene, max_edges, program, folder):
    """The path of a golden that is not one of golden/renders/. It is made here, or taken from an earlier run."""
    made = os.path.join(folder, "goldens")
    os.makedirs(made, exist_ok=True)
    ran = subprocess.run([program, "golden", scene, "--folder", made, "-q", "--max-edges", str(max_edges),
                          "-s", str(GOLDEN_SAMPLES)], capture_output=True, text=True)
    name = os.path.splitext(os.path.basename(scene))[0]
    if ran.returncode != 0:
        raise Problem(f"{name}: {ran.stderr.strip()}")
    return os.path.join(made, name + ".exr")


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (Problem, OSError) as problem:
        print(f"conformance: {problem}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        print("conformance: interrupted; the page is unchanged", file=sys.stderr)
        sys.exit(130)
