"""Writes a scene for Mitsuba 3: an XML file, and a PLY file for each material of triangles."""

import os
from xml.sax.saxutils import quoteattr

from problem import Problem
from write_ply import write_ply


def write_mitsuba(scene, folder, width, height, max_edges):
    """Returns the path of the XML file. The integrator's max_depth counts edges as Plumbline does: 1 shows
    emitters alone, 2 direct light. Roulette starts after rr_depth edges, that is never."""
    lines = ['<scene version="3.0.0">',
             '<integrator type="path">', _number("integer", "max_depth", max_edges),
             _number("integer", "rr_depth", max_edges + 1), '</integrator>', *_sensor(scene.camera, width, height)]
    for index, triangles in sorted(scene.triangles.items()):
        name = f"{scene.name}_{index}.ply"
        write_ply(os.path.join(folder, name), triangles)
        lines += ['<shape type="ply">', f'<string name="filename" value={quoteattr(name)}/>',
                  '<boolean name="face_normals" value="true"/>', *_surface(scene.materials[index]), '</shape>']
    for center, radius, index in scene.spheres:
        lines += ['<shape type="sphere">', f'<point name="center" value="{_list(center)}"/>',
                  _number("float", "radius", radius), *_surface(scene.materials[index]), '</shape>']
    path = os.path.join(folder, scene.name + ".xml")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join([*lines, "</scene>", ""]))
    return path


def _number(kind, name, value):
    return f'<{kind} name="{name}" value="{value!r}"/>'


def _list(values):
    return ", ".join(map(repr, values))


def _rgb(name, color):
    return f'<rgb name="{name}" value="{_list(color)}"/>'


def _sensor(camera, width, height):
    """Mitsuba's camera looks along its +z, with +x to the left in the picture."""
    left = [-c for c in camera.right]
    forward = [-c for c in camera.backward]
    rows = [(left[i], camera.up[i], forward[i], camera.eye[i]) for i in range(3)] + [(0.0, 0.0, 0.0, 1.0)]
    matrix = " ".join(repr(float(value)) for row in rows for value in row)
    # No clipping: the planes are far outside of every scene that is compared.
    return ['<sensor type="perspective">', f'<string name="fov_axis" value="{camera.fov_axis}"/>',
            _number("float", "fov", camera.fov), _number("float", "near_clip", 1e-3),
            _number("float", "far_clip", 1e4), f'<transform name="to_world"><matrix value="{matrix}"/></transform>',
            '<sampler type="independent"/>',
            '<film type="hdrfilm">', _number("integer", "width", width), _number("integer", "height", height),
            '<string name="pixel_format" value="rgb"/>', '<string name="component_format" value="float32"/>',
            '<rfilter type="box"/>', '</film>', '</sensor>']


def _surface(material):
    """Plumbline's Lambertian surfaces and mirrors have two sides. Emitters reflect nothing."""
    if material.kind == "lambertian":
        return ['<bsdf type="twosided"><bsdf type="diffuse">', _rgb("reflectance", material.color), '</bsdf></bsdf>']
    if material.kind == "mirror":
        return ['<bsdf type="twosided"><bsdf type="conductor">', '<string name="material" value="none"/>',
                _rgb("specular_reflectance", material.color), '</bsdf></bsdf>']
    if material.kind == "glass":
        return ['<bsdf type="dielectric">', _number("float", "int_ior", material.ior),
                _number("float", "ext_ior", 1.0), _rgb("specular_reflectance", material.color),
                _rgb("specular_transmittance", material.transmittance), '</bsdf>']
    if material.kind == "emission":
        return ['<bsdf type="diffuse">', _rgb("reflectance", (0.0, 0.0, 0.0)), '</bsdf>',
                '<emitter type="area">', _rgb("radiance", material.color), '</emitter>']
    raise Problem(f"no way to write {material.kind} for Mitsuba")
