"""Who is measured on a scene, and which ratios are formed."""

import glob
import os
from dataclasses import dataclass

from peer import Peer
from problem import Problem
from write_luxcore import write_luxcore

PATH_EDGES = 6
# LuxCore limits the eye walk and the light walk of BIDIRCPU and not the path: with so many edges, the paths that
# one side has and the other has not are too dark to matter.
BIDIRECTIONAL_EDGES = 24

MITSUBA = {"mitsuba llvm": "llvm_ad_rgb", "mitsuba scalar": "scalar_rgb"}
LUXCORE = {"luxcore path": ("PATHCPU", PATH_EDGES), "luxcore bidir": ("BIDIRCPU", BIDIRECTIONAL_EDGES)}
PLUMBLINE = {"plumbline path": ("path", PATH_EDGES), "plumbline bdpt": ("bdpt", PATH_EDGES),
             "plumbline bdpt 24": ("bdpt", BIDIRECTIONAL_EDGES)}

# (numerator, denominator): both draw the same picture, of paths with at most as many edges.
PAIRS = [("plumbline path", "mitsuba llvm"), ("plumbline path", "mitsuba scalar"), ("plumbline path", "luxcore path"),
         ("plumbline bdpt 24", "luxcore bidir"), ("plumbline bdpt", "plumbline path"),
         ("plumbline bdpt", "mitsuba llvm")]


@dataclass(frozen=True)
class Job:
    """One scene and one way to render it, for Plumbline."""
    scene_path: str
    frame: bool
    width: int
    height: int
    integrator: str
    max_edges: int


@dataclass
class Contestant:
    scene: str
    name: str
    render: object  # of spp, seed, threads


def pairs_of(only):
    """The pairs that take part if only the libraries named in `only` do."""
    groups = {"mitsuba": MITSUBA, "luxcore": LUXCORE}
    excluded = {name for group, names in groups.items() if group not in only for name in names}
    return [pair for pair in PAIRS if not excluded & set(pair)]


def libllvm():
    """For Mitsuba's LLVM backend. The newest that Debian 12 has comes first."""
    for pattern in ("libLLVM-19.so", "libLLVM.so.19*", "libLLVM-15.so", "libLLVM-15.so.1"):
        for path in sorted(glob.glob(f"/usr/lib/*/{pattern}")):
            return path
    return None


def start_peers(python, log_folder, only):
    """The workers of the libraries named in `only` by contestant, their versions, and why others do not start."""
    environment = {"PYTHONDONTWRITEBYTECODE": "1"}
    if "DRJIT_LIBLLVM_PATH" not in os.environ and libllvm():
        environment["DRJIT_LIBLLVM_PATH"] = libllvm()
    peers = {name: Peer(name.replace(" ", "_"), python, "mitsuba_worker.py", [variant], log_folder, environment)
             for name, variant in MITSUBA.items() if "mitsuba" in only}
    luxcore = Peer("luxcore", python, "luxcore_worker.py", [], log_folder, environment)
    peers |= {name: luxcore for name in LUXCORE if "luxcore" in only}
    versions, missing = {}, {}
    for name, peer in list(peers.items()):
        try:
            versions[name] = peer.ask(do="version")["version"]
        except (Problem, OSError) as error:
            missing[name] = str(error)
            del peers[name]
    return peers, versions, missing


def contestants_of(path, frame, size, plumbline, peers, folder):
    """The contestants on one scene, and a line for each that cannot take part."""
    name_of_scene = os.path.splitext(os.path.basename(path))[0]
    found, absent = [], {}
    exported = plumbline.export(path, frame, size, PATH_EDGES, folder) if peers else None
    found += [Contestant(name_of_scene, name, _mitsuba(peers[name], exported)) for name in MITSUBA if name in peers]
    if any(name in peers for name in LUXCORE):
        try:
            file = write_luxcore(exported)
            found += [Contestant(name_of_scene, name, _luxcore(peers[name], file, engine, size, edges))
                      for name, (engine, edges) in LUXCORE.items()]
        except Problem as problem:
            absent["luxcore"] = str(problem)
    bidirectional = any(each.name == "luxcore bidir" for each in found)
    for name, (integrator, edges) in PLUMBLINE.items():
        if edges == PATH_EDGES or bidirectional:
            job = Job(path, frame, *size, integrator, edges)
            found.append(Contestant(name_of_scene, name, _plumbline(plumbline, job)))
    return found, absent


def _mitsuba(peer, file):
    return lambda spp, seed, threads: peer.ask(do="render", path=file, spp=spp, seed=seed, threads=threads)


def _luxcore(peer, file, engine, size, edges):
    return lambda spp, seed, threads: peer.ask(do="render", path=file, engine=engine, width=size[0], height=size[1],
                                               max_edges=edges, spp=spp, seed=seed, threads=threads)


def _plumbline(plumbline, job):
    return lambda spp, seed, threads: plumbline.render(job, spp, seed, threads)
