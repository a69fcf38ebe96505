"""LuxCore as a peer: PATHCPU and BIDIRCPU."""

import array
import time

from worker import cpu_seconds, serve  # first: it takes care of standard output

import pyluxcore

from blocks import block_means
from luxcore_settings import settings

pyluxcore.Init(lambda message: None)
scenes = {}
WARM_SECONDS = 0.3
POLL_SECONDS = 0.005


def version():
    return {"version": f"LuxCore {pyluxcore.Version()}"}


def scene_of(path):
    if path not in scenes:
        scenes[path] = pyluxcore.Scene()
        scenes[path].Parse(pyluxcore.Properties(path))
    return scenes[path]


def configuration(*arguments):
    properties = pyluxcore.Properties()
    for name, value in settings(*arguments).items():
        properties.Set(pyluxcore.Property(name, value))
    return properties


def sample_count(session):
    session.UpdateStats()
    return session.GetStats().Get("stats.renderengine.total.samplecount").GetFloat()


def wait_for(session, seconds, samples):
    """Until so much time has passed and there are so many samples. Returns time, CPU time and their number."""
    end = time.perf_counter() + seconds
    while True:
        time.sleep(POLL_SECONDS)
        now, cpu, count = time.perf_counter(), cpu_seconds(), sample_count(session)
        if now >= end and count >= samples:
            return now, cpu, count


def render(path, engine, width, height, max_edges, spp, seed, threads):
    """Samples and times between two moments of a running render, so that its start is not part of them."""
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(
        configuration(engine, width, height, max_edges, threads, seed), scene_of(path)))
    session.Start()
    start, cpu, count = wait_for(session, WARM_SECONDS, 1)
    end, cpu_end, count_end = wait_for(session, 0.0, count + spp * width * height)
    session.Stop()
    values = array.array("f", [0.0]) * (3 * width * height)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, values, 0)
    return {"samples": count_end - count, "seconds": end - start, "cpu_seconds": cpu_end - cpu,
            "means": block_means(values, width, height, top_first=False)}


serve({"version": version, "render": render})
