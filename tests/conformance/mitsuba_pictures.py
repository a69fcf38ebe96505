"""Mitsuba 3 as a source of pictures: mitsuba_pictures.py VARIANT (the protocol: tests/peers/worker.py)."""

import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "peers"))

from worker import serve  # first: it takes care of standard output

import mitsuba

mitsuba.set_variant(sys.argv[1])
mitsuba.set_log_level(mitsuba.LogLevel.Warn)


def version():
    return {"version": f"Mitsuba {mitsuba.__version__}, {sys.argv[1]}"}


def render(path, spp, seeds, folder, integrator, max_edges):
    """One picture for each seed, as folder/SEED.exr. The integrator is that of the file if its type is "path"."""
    scene = mitsuba.load_file(path)
    other = None
    if integrator != "path":
        other = mitsuba.load_dict({"type": integrator, "max_depth": max_edges, "rr_depth": max_edges + 1})
    files = []
    for seed in seeds:
        image = mitsuba.render(scene, spp=spp, seed=seed, integrator=other)
        files.append(os.path.join(folder, f"{seed}.exr"))
        bitmap = mitsuba.Bitmap(image)
        bitmap.convert(mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, False).write(files[-1])
    return {"files": files}


serve({"version": version, "render": render})
