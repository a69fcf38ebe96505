"""Exports Plumbline's scenes, renders them with Mitsuba 3 and lets `plumbline compare` judge the pictures.
./run conformance makes the virtual environment and calls this."""

import argparse
import glob
import json
import os
import shutil
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.append(os.path.join(ROOT, "tests", "peers"))

from contestants import libllvm
from machine import processor
from peer import Peer
from problem import Problem

from page import write_page

MAX_EDGES = 6  # of the goldens
# Per picture. The first two need more, because path tracing hardly finds their light. In the others Mitsuba's pictures
# have far less noise than those of the golden; then compare cannot exclude that they lack rare events.
SAMPLES = {"ceiling_lamp": 512, "door_ajar": 512, "directional_over_plane": 4, "integrating_sphere": 4,
           "integrating_sphere_lamp": 4}
ORDINARY_SAMPLES = 64
# The type of integrator where Mitsuba's path tracer finds no light.
INTEGRATORS = {"point_in_glass": "ptracer"}


def options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scenes", help="names, separated by commas [all in scenes/]")
    parser.add_argument("--pictures", type=int, default=64, help="of each scene, with different seeds [64]")
    parser.add_argument("--variant", help="of Mitsuba [llvm_ad_rgb if there is an LLVM for it, or scalar_rgb]")
    parser.add_argument("--seed", type=int, default=1, help="of the first picture [1]")
    parser.add_argument("--page", help="write the table into this page, between its marks: docs/results/conformance.md")
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
    if given.pictures < 2:
        raise Problem("--pictures: at least 2, because their noise is measured")
    llvm = os.environ.get("DRJIT_LIBLLVM_PATH") or libllvm() or ""
    variant = given.variant or ("llvm_ad_rgb" if llvm else "scalar_rgb")
    python = os.path.join(ROOT, "build", "peers", "venv", "bin", "python")
    mitsuba = Peer("mitsuba", python, os.path.join(HERE, "mitsuba_pictures.py"), [variant], folder,
                   {"PYTHONDONTWRITEBYTECODE": "1", "DRJIT_LIBLLVM_PATH": llvm})
    results = {"version": mitsuba.ask(do="version")["version"], "processor": processor(), "pictures": given.pictures,
               "scenes": []}
    try:
        for name in names:
            result = judge(name, program, mitsuba, folder, given)
            results["scenes"].append(result)
            print(f"{name}: {result['verdict']}: {result['reason']} ({result['seconds']:.0f} s)", flush=True)
    finally:
        mitsuba.stop()
    with open(os.path.join(folder, "conformance.json"), "w", encoding="utf-8") as file:
        json.dump(results, file, indent=1)
    if given.page:
        if not given.scenes:
            results["explained"] = explanations(python, folder, variant, llvm)
        write_page(given.page, results)
    return 0


def explanations(python, folder, variant, llvm):
    """What explain.py measures."""
    ran = subprocess.run([python, "-B", os.path.join(HERE, "explain.py"), folder, variant], capture_output=True, text=True,
                         env={**os.environ, "DRJIT_LIBLLVM_PATH": llvm})
    if ran.returncode != 0 or not ran.stdout:
        raise Problem(f"explain.py: {(ran.stderr.strip() or 'no answer').splitlines()[-1]}")
    return json.loads(ran.stdout)


def judge(name, program, mitsuba, folder, given):
    """The verdict on Mitsuba's pictures of one scene, or why there are none."""
    start = time.time()
    xml = os.path.join(folder, name, name + ".xml")
    shutil.rmtree(os.path.dirname(xml), ignore_errors=True)
    os.makedirs(os.path.dirname(xml))
    exported = subprocess.run([program, "export", os.path.join(ROOT, "scenes", name + ".dae"), "-q", "-o", xml,
                               "--size", "64x64", "--max-edges", str(MAX_EDGES)], capture_output=True, text=True)
    if exported.returncode != 0:
        reason = exported.stderr.strip().removeprefix("plumbline: ").removeprefix(name + ": ")
        return {"scene": name, "verdict": "not exported", "reason": reason, "seconds": time.time() - start}
    samples, integrator = SAMPLES.get(name, ORDINARY_SAMPLES), INTEGRATORS.get(name, "path")
    seeds = list(range(given.seed, given.seed + given.pictures))
    files = mitsuba.ask(limit=3600, do="render", path=xml, spp=samples, seeds=seeds, folder=os.path.dirname(xml),
                        integrator=integrator, max_edges=MAX_EDGES)["files"]
    golden = os.path.join(ROOT, "golden", "renders", name + ".exr")
    compared = subprocess.run([program, "compare", *files, golden, "-q", "--json",
                               "--report", os.path.join(folder, name + ".html")], capture_output=True, text=True)
    if not compared.stdout:
        raise Problem(f"{name}: {compared.stderr.strip()}")
    verdict = json.loads(compared.stdout)
    kept = ("verdict", "reason", "p", "coverage", "detectable", "summary", "whole")
    return {"scene": name, "samples": samples, "integrator": integrator, "seconds": time.time() - start,
            **{key: verdict[key] for key in kept}}


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (Problem, OSError) as problem:
        print(f"conformance: {problem}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        print("conformance: interrupted; the page is unchanged", file=sys.stderr)
        sys.exit(130)
