"""Measures, with Mitsuba, what the differences in docs/results/conformance.md are explained by: explain.py FOLDER
VARIANT, with FOLDER/NAME/NAME.xml as ./run conformance exports them. Prints one JSON object.

Mitsuba 3.9 moves the origin of a ray by (1 + max |p|) RayEpsilon along the normal, and ends a shadow ray
ShadowEpsilon of its length before the light (mitsuba/render/interaction.h: offset_p, spawn_ray_to)."""

import json
import os
import sys
import xml.etree.ElementTree as ElementTree

RESULTS = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)

import mitsuba
import numpy as np

mitsuba.set_variant(sys.argv[2])

RAY_EPSILON = 1500 * 2.0**-24
SHADOW_EPSILON = 10 * RAY_EPSILON
EDGES = (2, 3, 4, 6, 8, 20)


def xml_of(name, max_depth, crop=None):
    """The scene with another limit of paths, without roulette; crop: the one pixel (x, y) of the picture to render."""
    path = os.path.join(sys.argv[1], name, name + ".xml")
    root = ElementTree.parse(path).getroot()
    integrator = root.find("integrator")
    integrator.find("integer[@name='max_depth']").set("value", str(max_depth))
    integrator.find("integer[@name='rr_depth']").set("value", "10000")
    for key, value in zip(("crop_offset_x", "crop_offset_y", "crop_width", "crop_height"), (*crop, 1, 1) if crop else ()):
        ElementTree.SubElement(root.find("sensor/film"), "integer", name=key, value=str(value))
    changed = path.replace(".xml", "_changed.xml")
    ElementTree.ElementTree(root).write(changed)
    return changed


def picture(name, max_depth, spp, seed):
    return np.array(mitsuba.render(mitsuba.load_file(xml_of(name, max_depth)), spp=spp, seed=seed))


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def camera_rays(name, film):
    """Origin and unit directions of rays through all pairs of these coordinates, each 1 to -1 over the square picture."""
    root = ElementTree.parse(xml_of(name, 2)).getroot()
    to_world = np.array(root.find(".//sensor/transform/matrix").get("value").split(), float).reshape(4, 4)
    tangent = np.tan(np.radians(float(root.find(".//sensor/float[@name='fov']").get("value"))) / 2)
    x, y = np.meshgrid(film[0] * tangent, film[1] * tangent)
    local = np.stack([x, y, np.ones_like(x)], -1)
    directions = local @ to_world[:3, :3].T
    return to_world[:3, 3], unit(directions)


def light_in_ball(max_edges, epsilon, ior=1.5, strata=24):
    """The mean radiance of the picture in multiples of n^2 Le, for a camera in the unit ball, if the origins of
    reflected rays move inwards by (1 + max |p|) epsilon. With 0 it is the closed form: 1 - F^(max_edges - 1)."""
    film = 1 - 2 * (np.arange(64 * strata) + 0.5) / (64 * strata)
    origin, d = camera_rays("camera_in_glass_furnace", (film, film))
    origin = np.broadcast_to(origin, d.shape)
    weight, light = np.ones(d.shape[:2]), np.zeros(d.shape[:2])
    for _ in range(max_edges - 1):
        b = (origin * d).sum(-1)
        t = -b + np.sqrt(b * b - (origin * origin).sum(-1) + 1)
        p = unit(origin + t[..., None] * d)
        cosine = (p * d).sum(-1)
        reflected = fresnel(cosine, ior)
        light = light + weight * (1 - reflected)
        weight = weight * reflected
        d = unit(d - 2 * cosine[..., None] * p)
        origin = p * (1 - (1 + abs(p).max(-1)) * epsilon)[..., None]
    return light.mean()


def ball():
    """Predicted and measured excess over the closed form."""
    rows = []
    for edges in EDGES:
        closed_form = light_in_ball(edges, 0)
        means = np.array([picture("camera_in_glass_furnace", edges, 64, seed)[..., 0].mean() for seed in range(1, 17)])
        ratios = means / (1.5**2 * 0.8 * closed_form)
        rows.append({"edges": edges, "predicted": light_in_ball(edges, RAY_EPSILON) / closed_form - 1,
                     "measured": ratios.mean() - 1, "error": ratios.std(ddof=1) / 4})
    return rows


def fresnel(cosine, ior):
    """Of a ray inside glass, which meets the surface at this cosine."""
    outside = np.sqrt(np.maximum(0, 1 - (1 - cosine**2) * ior**2))
    parallel = (ior * outside - cosine) / (ior * outside + cosine)
    perpendicular = (ior * cosine - outside) / (ior * cosine + outside)
    return np.where((1 - cosine**2) * ior**2 >= 1, 1, (parallel**2 + perpendicular**2) / 2)


def edge_pixel(x=21, y=2, grid=2000, ior=1.5):
    """The pixel of camera_in_glass that the outline of the luminous sphere hardly enters: the share of its area that shows
    the sphere, the light that is due to it, and what many samples of Mitsuba's say. Numbers: scenes/camera_in_glass.dae."""
    inside = (np.arange(grid) + 0.5) / grid
    eye, d = camera_rays("camera_in_glass", (1 - 2 * (x + inside) / 64, 1 - 2 * (y + inside) / 64))
    ball, sphere, radius = np.array([2.25, -2.36, 2.41]), np.array([-0.1, 0.4, 0.8]), 0.4
    origin = eye - ball
    b = (origin * d).sum(-1)
    p = origin + (-b + np.sqrt(b * b - (origin * origin).sum() + 0.25**2))[..., None] * d
    normal = unit(p)
    cosine = (normal * d).sum(-1)
    d = ior * d + (np.sqrt(1 - ior**2 * (1 - cosine**2)) - ior * cosine)[..., None] * normal
    to_sphere = sphere - ball - p
    along = (to_sphere * d).sum(-1)
    seen = (along > 0) & ((to_sphere**2).sum(-1) - along**2 < radius**2)
    weight = 1 - fresnel(cosine, ior)

    def measured(edges):
        scene = mitsuba.load_file(xml_of("camera_in_glass", edges, (x, y)))
        blue = np.array([np.array(mitsuba.render(scene, spp=1 << 20, seed=seed))[0, 0, 2] for seed in range(1, 9)])
        return {"mean": float(blue.mean()), "error": float(blue.std(ddof=1)) / len(blue) ** 0.5}

    return {"x": x, "y": y, "share": seen.mean(), "hits": 4096 * (seen * weight).mean(),
            "predicted": ior**2 * 2 * (seen * weight).mean(), "direct": measured(2), "all": measured(6)}


def ply_triangles(path):
    with open(path, "rb") as file:
        head, _, body = file.read().partition(b"end_header\n")
    points, faces = (int(head.split(b"element " + name + b" ")[1].split()[0]) for name in (b"vertex", b"face"))
    vertices = np.frombuffer(body, "<f8", 3 * points).reshape(points, 3)
    corners = np.frombuffer(body[24 * points:], np.dtype([("n", "u1"), ("v", "<i4", 3)]), faces)["v"]
    return vertices[corners]


def first_hits(origins, directions, triangles):
    """The smallest t in (0, 1) with origin + t direction on a triangle, or infinity."""
    nearest = np.full(len(origins), np.inf)
    for a, b, c in triangles:
        normal = np.cross(b - a, c - a)
        with np.errstate(divide="ignore", invalid="ignore"):
            t = ((a - origins) @ normal) / (directions @ normal)
            p = origins + t[:, None] * directions
            inside = np.ones(len(origins), bool)
            for u, v in ((a, b), (b, c), (c, a)):
                inside &= np.cross(v - u, p - u) @ normal >= 0
        nearest = np.where(inside & (t > 0) & (t < 1) & (t < nearest), t, nearest)
    return nearest


def lamp():
    """Segments from the walls above the luminaire to the luminaire: the bowl blocks them all."""
    folder = os.path.join(sys.argv[1], "ceiling_lamp")
    bowl = ply_triangles(os.path.join(folder, "ceiling_lamp.brass_3.ply"))
    luminaire = ply_triangles(os.path.join(folder, "ceiling_lamp.luminaire_4.ply")).reshape(-1, 3)
    low, high = luminaire.min(0), luminaire.max(0)
    random = np.random.default_rng(1)
    count = 200000
    walls = random.uniform((-2, -2, 1.6), (2, 2, 2.4), (count, 3))
    walls[np.arange(count), random.integers(0, 2, count)] = random.choice([-2.0, 2.0], count)
    hits = first_hits(walls, random.uniform(low, high, (count, 3)) - walls, bowl)
    light = picture("ceiling_lamp", 2, 4096, 1).sum(-1)
    # The closed form: nothing but the ceiling and the inside of the bowl is lit. The inside is not seen from below, and
    # the ceiling only 12 degrees above the horizon and more: in the first 24 of 64 rows.
    lower = light[24:]
    return {"segments": count, "unblocked": int((hits == np.inf).sum()),
            "blocked_too_late": int(((hits < np.inf) & (hits > 1 - SHADOW_EPSILON)).sum()),
            "rows_below": 24, "pixels": int(lower.size), "lit": int((lower > 0).sum()),
            "share": float(lower.sum() / light.sum())}


print(json.dumps({"ball": ball(), "lamp": lamp(), "pixel": edge_pixel()}), file=RESULTS, flush=True)
os._exit(0)  # the destructors of some libraries crash at the end of the interpreter
