"""Mitsuba 3 as a peer: mitsuba_worker.py VARIANT."""

import sys
import time

from worker import cpu_seconds, serve  # first: it takes care of standard output

import drjit
import mitsuba
import numpy

from blocks import block_means

mitsuba.set_variant(sys.argv[1])
mitsuba.set_log_level(mitsuba.LogLevel.Warn)
loaded = {}
warm = set()


def version():
    return {"version": f"Mitsuba {mitsuba.__version__} {sys.argv[1]}"}


def load(path):
    if loaded.get("path") != path:
        loaded.update(path=path, scene=mitsuba.load_file(path))
    return {}


def picture(spp, seed):
    """The samples as a flat array. Copying it to the CPU's memory waits for the kernels."""
    scene = loaded["scene"]
    image = scene.integrator().render(scene, seed=seed, spp=spp)
    return mitsuba.TensorXf(image).array.numpy() if "llvm" in sys.argv[1] else image


def render(path, spp, seed, threads, **_):
    """Times one render. Its kernels are compiled and in the cache: one render with the same number of samples
    goes before the first that is timed."""
    load(path)
    drjit.set_thread_count(threads)
    if (path, spp, threads) not in warm:
        picture(spp, seed + 1)
        warm.add((path, spp, threads))
    start, cpu = time.perf_counter(), cpu_seconds()
    image = picture(spp, seed)
    seconds, cpu = time.perf_counter() - start, cpu_seconds() - cpu
    width, height = loaded["scene"].sensors()[0].film().size()
    values = numpy.array(image).reshape(-1).tolist()
    return {"samples": int(width) * int(height) * spp, "seconds": seconds, "cpu_seconds": cpu,
            "means": block_means(values, int(width), int(height), top_first=True)}


serve({"version": version, "load": load, "render": render})
