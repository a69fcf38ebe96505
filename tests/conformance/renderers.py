"""Who renders the scenes of ./run conformance, and how."""

import hashlib
import json
import os
import shutil
import sys
from dataclasses import dataclass, field

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "peers"))

from peer import Peer

MAX_EDGES = 6  # of the goldens
ORIGIN = "origin.json"
SCRIPTS = [os.path.join(HERE, name) for name in ("mitsuba_pictures.py", "luxcore_pictures.py", "../peers/luxcore_settings.py",
                                                 "../peers/write_luxcore.py")]
# LuxCore's bidirectional engine limits its two walks and not the path. With so many vertices of each, paths that are cut
# off are too dark to matter; its pictures are judged by a golden without limit. Its roulette is biased (docs/results/
# conformance.md), and without it walks in closed rooms take too long: these scenes are left out.
WALK = 24
UNLIMITED = 1 << 20
OPEN = ("area_light_over_plane", "camera_in_glass", "directional_over_plane", "light_in_glass", "mirror_image", "near_occluder",
        "point_in_glass", "point_over_plane", "sphere_over_plane")

# Per picture. These two need more, because path tracing hardly finds their light.
SAMPLES = {"ceiling_lamp": 512, "door_ajar": 512}
ORDINARY_SAMPLES = 64


@dataclass(frozen=True)
class Renderer:
    """`integrator` is the renderer's word for it; `others` holds another one for scenes in which it finds no light.
    `golden_edges` is the limit of paths of the golden, if it is not one of golden/renders/."""
    name: str
    title: str
    peer: str
    integrator: str
    max_edges: int = MAX_EDGES
    samples: dict = field(default_factory=lambda: SAMPLES)
    others: dict = field(default_factory=dict)
    golden_edges: int = None
    scenes: tuple = None  # none: all


RENDERERS = {each.name: each for each in (
    Renderer("mitsuba", "", "mitsuba", "path", others={"point_in_glass": "ptracer"}),
    Renderer("luxcore", "PATHCPU", "luxcore", "PATHCPU", samples={**SAMPLES, "door_ajar": 128}, others={"point_in_glass": "LIGHTCPU"}),
    Renderer("bidir", "BIDIRCPU", "luxcore", "BIDIRCPU", WALK, {}, golden_edges=UNLIMITED, scenes=OPEN))}


class Peers:
    """The programs that render, started when first asked."""

    def __init__(self, python, variant, llvm, folder):
        environment = {"PYTHONDONTWRITEBYTECODE": "1", "DRJIT_LIBLLVM_PATH": llvm}
        self.by_name = {name: Peer(name, python, os.path.join(HERE, f"{name}_pictures.py"), arguments, folder, environment)
                        for name, arguments in (("mitsuba", [variant]), ("luxcore", []))}

    def version(self, renderer):
        version = self.by_name[renderer.peer].ask(do="version")["version"]
        return f"{version}, {renderer.title}" if renderer.title else version

    def render(self, renderer, scene, path, seeds, folder, keep):
        """The files of the pictures, and what they were rendered with. `keep`: those that an earlier run has left in the folder
        are taken if they were made from the same file in the same way."""
        samples = renderer.samples.get(scene, ORDINARY_SAMPLES)
        integrator = renderer.others.get(scene, renderer.integrator)
        request = {"path": path, "spp": samples, "folder": folder, "integrator": integrator, "max_edges": renderer.max_edges}
        with open(path, encoding="utf-8") as file:
            origin = {**request, "version": self.version(renderer), "scene": file.read(), "scripts": hash_of(SCRIPTS)}
        there = pictures_in(folder) if keep and origin_of(folder) == origin else {}
        if not there:
            shutil.rmtree(folder, ignore_errors=True)
            os.makedirs(folder)
            with open(os.path.join(folder, ORIGIN), "w", encoding="utf-8") as file:
                json.dump(origin, file)
        missing = [seed for seed in seeds if seed not in there]
        if missing:
            self.by_name[renderer.peer].ask(limit=3600, do="render", seeds=missing, **request)
            there = pictures_in(folder)
        other = "" if integrator == renderer.integrator else integrator
        return [there[seed] for seed in seeds], {"pictures": len(seeds), "samples": samples, "integrator": other}

    def stop(self):
        for peer in self.by_name.values():
            peer.stop()


def hash_of(paths):
    """Of the files' bytes, hexadecimal."""
    digest = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            digest.update(file.read())
    return digest.hexdigest()


def pictures_in(folder):
    """Paths by seed."""
    return {int(name.partition(".")[0]): os.path.join(folder, name)
            for name in os.listdir(folder) if name.endswith((".exr", ".pfm"))}


def origin_of(folder):
    """What the pictures in the folder were made from; None if that is not known."""
    try:
        with open(os.path.join(folder, ORIGIN), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return None
