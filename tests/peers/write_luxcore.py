"""Writes a scene for LuxCore, from the XML that `plumbline export` writes for Mitsuba 3: a .scn file beside it. Only
what those files use is understood; anything else is an error."""

import math
import os
import struct
import xml.etree.ElementTree as ElementTree

from problem import Problem

# LuxCore has no exact spheres. Each facet of an emitter is a light, and LuxCore's start takes minutes with many.
RINGS = 128
EMITTER_RINGS = 64
# Power and efficiency of 0, and no normalisation: the numbers of a light are its radiance, intensity or irradiance.
AS_IT_IS = {"power": 0, "efficency": 0, "normalizebycolor": 0}


def write_luxcore(path, spheres=False):
    """Returns the path of the .scn file. `spheres`: whether they are written, as meshes. Raises Problem."""
    root = ElementTree.parse(path).getroot()
    if not spheres and root.find("shape[@type='sphere']") is not None:
        raise Problem(f"{os.path.basename(path)}: LuxCore has no exact spheres")
    folder = os.path.dirname(os.path.abspath(path))
    lines = _camera(root.find("sensor"))
    for bsdf in root.findall("bsdf"):
        lines += _material(bsdf.get("id"), bsdf)
    for index, shape in enumerate(root.findall("shape")):
        material = shape.find("ref").get("id")
        lines += _properties(f"scene.objects.o{index}", ply=f'"{_mesh(shape, folder, index)}"', material=f'"{material}"')
        if shape.find("emitter") is not None:
            lines += _emission(material, shape.find("emitter"))
    for index, emitter in enumerate(root.findall("emitter")):
        lines += _light(f"scene.lights.l{index}", emitter)
    scn = os.path.splitext(path)[0] + ".scn"
    with open(scn, "w", encoding="utf-8") as file:
        file.write("\n".join([*lines, ""]))
    return scn


def _properties(prefix, **values):
    return [f"{prefix}.{name} = {value}" for name, value in values.items()]


def _text(values):
    return " ".join(repr(float(value)) for value in values)


def _value(element, name):
    found = element.find(f"*[@name='{name}']")
    if found is None:
        raise Problem(f"<{element.tag} type={element.get('type')}> has no {name}")
    return found.get("value")


def _numbers(element, name):
    return [float(number) for number in _value(element, name).replace(",", " ").split()]


def _camera(sensor):
    """The field of view spans -1 to 1 of the window's coordinates. LuxCore turns row y of the film, from below, into
    height - y - 1, where half a pixel would be counted by height - y: the window is moved down by one row."""
    matrix = [float(number) for number in sensor.find("transform/matrix").get("value").split()]
    left, up, forward, eye = (matrix[column:12:4] for column in range(4))
    width, height = (int(_value(sensor.find("film"), name)) for name in ("width", "height"))
    if _value(sensor, "fov_axis") == "x":
        right, top = 1.0, height / width
    else:
        right, top = width / height, 1.0
    normal = [up[1] * forward[2] - up[2] * forward[1], up[2] * forward[0] - up[0] * forward[2],
              up[0] * forward[1] - up[1] * forward[0]]
    if sum(map(float.__mul__, left, normal)) < 0:
        raise Problem("LuxCore has no mirrored cameras")
    row = 2 * top / height
    return ['scene.camera.type = "perspective"', f"scene.camera.lookat.orig = {_text(eye)}",
            f"scene.camera.lookat.target = {_text(map(float.__add__, eye, forward))}",
            f"scene.camera.up = {_text(up)}", f"scene.camera.fieldofview = {_value(sensor, 'fov')}",
            "scene.camera.autofocus.enable = 0",
            f"scene.camera.screenwindow = {_text((-right, right, -top - row, top - row))}"]


def _material(name, bsdf):
    prefix, kind = f"scene.materials.{name}", bsdf.get("type")
    if kind == "twosided":  # all of LuxCore's surfaces are
        return _material(name, bsdf.find("bsdf"))
    if kind == "diffuse":
        return _properties(prefix, type='"matte"', kd=_text(_numbers(bsdf, "reflectance")))
    if kind == "conductor":
        return _properties(prefix, type='"mirror"', kr=_text(_numbers(bsdf, "specular_reflectance")))
    if kind == "dielectric":
        return _properties(prefix, type='"glass"', kr=_text(_numbers(bsdf, "specular_reflectance")),
                           kt=_text(_numbers(bsdf, "specular_transmittance")),
                           interiorior=_value(bsdf, "int_ior"), exteriorior=_value(bsdf, "ext_ior"))
    raise Problem(f"no way to write a {kind} surface for LuxCore")


def _emission(material, emitter):
    """One side, that of the normal. Without "ENABLED" LuxCore samples no light of a mesh of more than 24 triangles."""
    prefix = f"scene.materials.{material}.emission"
    settings = _properties(prefix, **AS_IT_IS)
    return [f"{prefix} = {_text(_numbers(emitter, 'radiance'))}", *settings,
            f'{prefix}.directlightsampling.type = "ENABLED"']


def _light(prefix, emitter):
    kind = emitter.get("type")
    if kind == "point":  # LuxCore divides by the solid angle of all directions
        color = [4 * math.pi * each for each in _numbers(emitter, "intensity")]
        return _properties(prefix, type='"point"', position=_text(_numbers(emitter, "position")), color=_text(color),
                           **AS_IT_IS)
    if kind == "directional":
        return _properties(prefix, type='"sharpdistant"', direction=_text(_numbers(emitter, "direction")),
                           color=_text(_numbers(emitter, "irradiance")), **AS_IT_IS)
    if kind == "constant":
        return _properties(prefix, type='"constantinfinite"', color=_text(_numbers(emitter, "radiance")))
    raise Problem(f"no way to write a {kind} light for LuxCore")


def _mesh(shape, folder, index):
    """The file of the triangles of a shape."""
    if shape.get("type") == "ply":
        return os.path.join(folder, _value(shape, "filename"))
    if shape.get("type") != "sphere":
        raise Problem(f"no way to write a {shape.get('type')} for LuxCore")
    path = os.path.join(folder, f"sphere_{index}.ply")
    emits = shape.find("emitter") is not None
    points, unit, faces = sphere(_numbers(shape, "center"), float(_value(shape, "radius")), EMITTER_RINGS if emits else RINGS)
    with open(path, "wb") as file:
        file.write(_ply(points, faces, None if emits else unit))
    return path


def sphere(center, radius, rings):
    """Points, unit vectors outwards at the points, and faces. It has the area of the sphere: so the mean area of its
    shadows is the sphere's as well, because it is convex, and as an emitter it has the sphere's power."""
    around = 2 * rings
    unit = [(0.0, 0.0, 1.0)]
    for i in range(1, rings):
        z, r = math.cos(math.pi * i / rings), math.sin(math.pi * i / rings)
        unit += [(r * math.cos(math.pi * j / rings), r * math.sin(math.pi * j / rings), z) for j in range(around)]
    unit.append((0.0, 0.0, -1.0))
    last = len(unit) - 1
    faces = []
    for j in range(around):
        k = (j + 1) % around
        faces += [(0, 1 + j, 1 + k), (last, last - around + k, last - around + j)]
        for first in range(1, last - around, around):
            faces += [(first + j, first + around + j, first + around + k), (first + j, first + around + k, first + k)]
    area = sum(_area(*(unit[corner] for corner in face)) for face in faces)
    scale = radius * math.sqrt(4 * math.pi / area)
    return [tuple(center[i] + scale * point[i] for i in range(3)) for point in unit], unit, faces


def _ply(points, faces, normals):
    """The bytes of a PLY file. Between the normals, if there are any, LuxCore interpolates: without them, glass would
    refract like a crystal. LuxCore's emitters use geometric and interpolated normals in the same sum; they get none."""
    reals = ["x", "y", "z"] if normals is None else ["x", "y", "z", "nx", "ny", "nz"]
    rows = points if normals is None else [(*point, *normal) for point, normal in zip(points, normals)]
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}",
            *(f"property float {name}" for name in reals),
            f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    body = [struct.pack(f"<{len(reals)}f", *row) for row in rows]
    return "\n".join(head).encode() + b"".join(body) + b"".join(struct.pack("<B3i", 3, *face) for face in faces)


def _area(a, b, c):
    u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
    return 0.5 * math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
