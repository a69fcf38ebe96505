"""Reads the COLLADA files of the compared scenes: what these files use, and an error for anything else that
would change the picture. The conventions are those of Plumbline's own reader, scenes/collada/."""

import os
import xml.etree.ElementTree as ElementTree

from collada_mesh import read_parts
from collada_names import Document
from problem import Problem
from scene import Camera, Material, Scene
from vectors import (IDENTITY, column, cross, dot, is_mirrored, length, point_at, product, rotation, scaled, scaling,
                     subtract, translation, unit)

UNSUPPORTED_IN_NODES = {"lookat", "skew", "instance_node", "instance_controller"}


def read_scene(path):
    """The scene in the file. Raises Problem."""
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise Problem(f"{path}: {error}") from None
    document = Document(path, root)
    reader = _Reader(document, Scene(os.path.splitext(os.path.basename(path))[0]))
    shown = document.target(document.child(document.child(root, "scene"), "instance_visual_scene"))
    for node in document.children(shown, "node"):
        reader.visit(node, IDENTITY)
    return reader.finished()


class _Reader:
    def __init__(self, document, scene):
        self.document = document
        self.scene = scene
        self.material_of = {}  # index by id
        self.area_lights = False

    def visit(self, node, parent):
        document = self.document
        to_world = parent
        for element in node:
            name = document.name(element)
            if name in UNSUPPORTED_IN_NODES:
                raise document.problem(element, "not supported here")
            to_world = product(to_world, _step(document, element, name))
        for element in node:
            name = document.name(element)
            if name == "node":
                self.visit(element, to_world)
            elif name == "instance_geometry":
                self.add_geometry(element, to_world)
            elif name == "instance_light":
                self.add_light(document.target(element))
            elif name == "instance_camera" and self.scene.camera is None:
                self.scene.camera = _camera(document, document.target(element), to_world)

    def finished(self):
        scene = self.scene
        if scene.camera is None:
            raise Problem(f"{self.document.path}: no camera")
        if not any(scene.materials[index].kind == "emission" for index in self.used_materials()):
            raise Problem(f"{self.document.path}: no emissive surface" +
                          (" (an area light alone is not supported here)" if self.area_lights else ""))
        return scene

    def used_materials(self):
        return {*self.scene.triangles, *(sphere[2] for sphere in self.scene.spheres)}

    def add_light(self, light):
        """An area light beside emissive surfaces is their second description: Plumbline skips it, too."""
        technique = self.document.cmu462(light)
        if technique is None:
            technique = self.document.child(light, "technique_common")
        kinds = {self.document.name(kind) for kind in technique}
        if kinds != {"area"}:
            raise self.document.problem(light, f"lights of this kind are not supported here: {', '.join(kinds)}")
        self.area_lights = True

    def add_geometry(self, instance, to_world):
        document = self.document
        geometry = document.target(instance)
        bound = {each.get("symbol"): document.by_id(each.get("target"), instance)
                 for each in instance.iter(document.qualified("instance_material"))}
        technique = document.cmu462(geometry)
        if technique is not None:
            if len(bound) != 1:
                raise document.problem(instance, "a sphere with one material is expected")
            self.add_sphere(technique, self.material(*bound.values()), to_world, instance)
            return
        for symbol, triangles in read_parts(document, geometry):
            if symbol not in bound:
                raise document.problem(instance, f"binds no material to {symbol}")
            world = [tuple(point_at(to_world, p) for p in triangle) for triangle in triangles]
            if is_mirrored(to_world):
                world = [(a, c, b) for a, b, c in world]
            self.scene.triangles.setdefault(self.material(bound[symbol]), []).extend(world)

    def add_sphere(self, technique, material, to_world, instance):
        document = self.document
        radius, = document.numbers(document.child(document.child(technique, "sphere"), "radius"), 1)
        axes = [column(to_world, i) for i in range(3)]
        lengths = list(map(length, axes))
        skew = max(abs(dot(axes[i], axes[(i + 1) % 3])) for i in range(3))
        if max(lengths) - min(lengths) > 1e-5 * max(lengths) or skew > 1e-5 * max(lengths) ** 2:
            raise document.problem(instance, "an ellipsoid is not supported")
        self.scene.spheres.append((column(to_world, 3), radius * sum(lengths) / 3, material))

    def material(self, element):
        key = element.get("id")
        if key not in self.material_of:
            self.material_of[key] = len(self.scene.materials)
            effect = self.document.target(self.document.child(element, "instance_effect"))
            self.scene.materials.append(_material(self.document, effect))
        return self.material_of[key]


def _step(document, element, name):
    """The transform that one child of a node stands for."""
    if name == "matrix":
        v = document.numbers(element, 16)
        if v[12:] != [0, 0, 0, 1]:
            raise document.problem(element, "the last row is not 0 0 0 1")
        return (tuple(v[0:4]), tuple(v[4:8]), tuple(v[8:12]))
    if name == "translate":
        return translation(document.numbers(element, 3))
    if name == "scale":
        return scaling(document.numbers(element, 3))
    if name == "rotate":
        v = document.numbers(element, 4)
        return rotation(v[:3], v[3])
    return IDENTITY


def _camera(document, camera, to_world):
    optics = document.child(document.child(camera, "optics"), "technique_common")
    perspective = document.child(optics, "perspective")
    axis = "x" if document.optional(perspective, "xfov") is not None else "y"
    fov, = document.numbers(document.child(perspective, axis + "fov"), 1)
    backward = unit(column(to_world, 2))
    up = column(to_world, 1)
    up = unit(subtract(up, scaled(dot(up, backward), backward)))
    right = cross(backward, up) if is_mirrored(to_world) else cross(up, backward)
    return Camera(column(to_world, 3), right, up, backward, axis, fov)


def _material(document, effect):
    technique = document.cmu462(effect)
    if technique is None:
        return _common(document, effect)
    kind, = technique
    name = document.name(kind)

    def color(channel):
        return tuple(document.numbers(document.child(kind, channel), 3))
    if name == "mirror":
        return Material("mirror", color("reflectance"))
    if name == "emission":
        return Material("emission", color("radiance"))
    if name == "glass":
        roughness = document.optional(kind, "roughness")
        if roughness is not None and document.numbers(roughness, 1) != [0]:
            raise document.problem(effect, "rough glass is not supported")
        ior, = document.numbers(document.child(kind, "ior"), 1)
        return Material("glass", color("reflectance"), color("transmittance"), ior)
    raise document.problem(effect, f"unknown material <{name}>")


def _common(document, effect):
    """Lambertian with the diffuse colour; the specular colour has no meaning in the CMU462 profile."""
    technique = document.child(document.child(effect, "profile_COMMON"), "technique")
    shaders = [shader for shader in technique if document.name(shader) in ("phong", "lambert", "blinn")]
    if len(shaders) != 1:
        raise document.problem(effect, "a phong, lambert or blinn shader is expected")
    emission = document.optional(shaders[0], "emission")
    if emission is not None and any(document.numbers(document.child(emission, "color"))[:3]):
        raise document.problem(effect, "emission outside the CMU462 profile is not supported here")
    diffuse = document.child(document.child(shaders[0], "diffuse"), "color")
    return Material("lambertian", tuple(document.numbers(diffuse)[:3]))
