"""How LuxCore is told to render what Plumbline does: box filter, no clamping, no adaptive sampling, linear RGB."""

NEVER = 1 << 20
# Thread i of a render with the seed s draws its random numbers from the seed s + i, so neighbouring seeds would give
# several pictures the same numbers.
SEEDS_APART = 1000


def settings(engine, width, height, max_edges, threads, seed, roulette=NEVER):
    """Properties by name. PATHCPU limits paths by max_edges as Plumbline does; BIDIRCPU and LIGHTCPU limit each of their
    walks. `roulette`: the depth from which paths may end by it."""
    depths = [f"path.pathdepth.{kind}" for kind in ("total", "diffuse", "glossy", "specular")]
    return {
        "renderengine.type": engine, "renderengine.seed": 1 + SEEDS_APART * seed, "native.threads.count": threads,
        "sampler.type": "RANDOM", "sampler.random.adaptive.strength": 0.0,
        "film.width": width, "film.height": height, "film.filter.type": "NONE",
        **{name: max_edges for name in depths}, "path.russianroulette.depth": roulette,
        "path.maxdepth": max_edges, "light.maxdepth": max_edges, "light.russianroulette.depth": roulette,
        "path.clamping.variance.maxvalue": 0.0, "film.noiseestimation.warmup": NEVER,
        "film.imagepipelines.0.0.type": "NOP", "film.outputs.0.type": "RGB", "film.outputs.0.filename": "unused.exr",
    }
