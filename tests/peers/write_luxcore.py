"""Writes a scene of triangles for LuxCore: a .scn file, and a PLY file for each material. LuxCore has no exact
spheres, so scenes with spheres are refused."""

import os

from problem import Problem
from write_ply import write_ply


def write_luxcore(scene, folder, width, height):
    """Returns the path of the .scn file."""
    if scene.spheres:
        raise Problem(f"{scene.name}: LuxCore has no exact spheres")
    lines = _camera(scene.camera, width, height)
    for index, triangles in sorted(scene.triangles.items()):
        path = os.path.abspath(os.path.join(folder, f"{scene.name}_{index}.ply"))
        write_ply(path, triangles)
        lines += [*_material(f"scene.materials.m{index}.", scene.materials[index]),
                  f'scene.objects.o{index}.ply = "{path}"', f'scene.objects.o{index}.material = "m{index}"']
    path = os.path.join(folder, scene.name + ".scn")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join([*lines, ""]))
    return path


def _list(values):
    return " ".join(repr(float(value)) for value in values)


def _camera(camera, width, height):
    """The field of view spans -1 to 1 of the window's coordinates. The film's rows are one below the rows of
    the window, and its last row would be empty: the window is moved down by one row."""
    if camera.fov_axis == "x":
        right, top = 1.0, height / width
    else:
        right, top = width / height, 1.0
    row = 2 * top / height
    target = [camera.eye[i] - camera.backward[i] for i in range(3)]
    return ['scene.camera.type = "perspective"', f"scene.camera.lookat.orig = {_list(camera.eye)}",
            f"scene.camera.lookat.target = {_list(target)}", f"scene.camera.up = {_list(camera.up)}",
            f"scene.camera.fieldofview = {camera.fov!r}", "scene.camera.autofocus.enable = 0",
            f"scene.camera.screenwindow = {_list((-right, right, -top - row, top - row))}"]


def _material(prefix, material):
    if material.kind == "lambertian":
        return [f'{prefix}type = "matte"', f"{prefix}kd = {_list(material.color)}"]
    if material.kind == "mirror":
        return [f'{prefix}type = "mirror"', f"{prefix}kr = {_list(material.color)}"]
    if material.kind == "emission":
        # Power and efficiency of 0, and no normalisation: the emission is the radiance.
        return [f'{prefix}type = "matte"', f"{prefix}kd = 0 0 0", f"{prefix}emission = {_list(material.color)}",
                f"{prefix}emission.power = 0", f"{prefix}emission.efficency = 0",
                f"{prefix}emission.normalizebycolor = 0"]
    raise Problem(f"no way to write {material.kind} for LuxCore")
