"""LuxCore as a source of pictures (the protocol: tests/peers/worker.py). Not with numpy: the two libraries crash together."""

import array
import os
import sys
import time
import xml.etree.ElementTree as ElementTree

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "peers"))

from worker import serve  # first: it takes care of standard output

import pyluxcore

from luxcore_settings import NEVER, settings
from write_luxcore import write_luxcore

pyluxcore.Init(lambda message: None)
POLL_SECONDS = 0.005


def version():
    return {"version": f"LuxCore {pyluxcore.Version()}"}


def size_of(path):
    film = ElementTree.parse(path).getroot().find("sensor/film")
    return (int(film.find(f"integer[@name='{name}']").get("value")) for name in ("width", "height"))


def render(path, spp, seeds, folder, integrator, max_edges, roulette=NEVER):
    """One picture for each seed, as folder/SEED.pfm, of at least so many samples per pixel. `integrator`: LuxCore's
    engine; `roulette`: the depth from which paths may end by it."""
    width, height = size_of(path)
    scene = pyluxcore.Scene()
    scene.Parse(pyluxcore.Properties(write_luxcore(path, spheres=True)))
    files = []
    for seed in seeds:
        properties = pyluxcore.Properties()
        # A walk from a light has one edge less than the path that it makes with the camera. Its limit is path.pathdepth, too.
        limit = max_edges - 1 if integrator == "LIGHTCPU" else max_edges
        chosen = settings(integrator, width, height, limit, os.cpu_count(), seed, roulette)
        for name, value in {**chosen, "batch.haltspp": spp}.items():
            properties.Set(pyluxcore.Property(name, value))
        files.append(os.path.join(folder, f"{seed}.pfm"))
        write_pfm(files[-1], picture(pyluxcore.RenderConfig(properties, scene), width, height), width, height)
    return {"files": files}


def picture(configuration, width, height):
    """Red, green and blue, from the bottom row up."""
    session = pyluxcore.RenderSession(configuration)
    session.Start()
    while not session.HasDone():
        time.sleep(POLL_SECONDS)
        session.UpdateStats()
    session.Stop()
    values = array.array("f", [0.0]) * (3 * width * height)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, values, 0)
    return values


def write_pfm(path, values, width, height):
    if sys.byteorder == "big":
        values.byteswap()
    with open(path, "wb") as file:
        file.write(f"PF\n{width} {height}\n-1.0\n".encode() + values.tobytes())


serve({"version": version, "render": render})
