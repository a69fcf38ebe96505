"""The writer of LuxCore's scenes, on a small scene as `plumbline export` writes it for Mitsuba; and the reader of PFM."""

import array
import math
import os
import tempfile
import unittest
from collections import Counter

import luxcore_settings
from plumbline import read_pfm
from problem import Problem
from write_luxcore import sphere, write_luxcore

SCENE = """<scene version="3.0.0">
<sensor type="perspective"><string name="fov_axis" value="x"/><float name="fov" value="90"/>
<transform name="to_world"><matrix value="{matrix}"/></transform>
<film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/></film></sensor>
<bsdf type="twosided" id="white_0"><bsdf type="diffuse"><rgb name="reflectance" value="0.25, 0.5, 0.75"/></bsdf></bsdf>
<bsdf type="diffuse" id="lamp_1"><rgb name="reflectance" value="0, 0, 0"/></bsdf>
<bsdf type="dielectric" id="glass_2"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>
<rgb name="specular_reflectance" value="1, 1, 1"/><rgb name="specular_transmittance" value="0.5, 0.5, 0.5"/></bsdf>
<shape type="ply"><string name="filename" value="small.white_0.ply"/><ref id="white_0"/></shape>
<shape type="ply"><string name="filename" value="small.lamp_1.ply"/><ref id="lamp_1"/>
<emitter type="area"><rgb name="radiance" value="4, 5, 6"/></emitter></shape>
<emitter type="point"><point name="position" value="1, 2, 3"/><rgb name="intensity" value="1, 2, 4"/></emitter>
{more}</scene>"""
# Looks along -z from (0, 0, 9), with x to the right: Mitsuba's first column is the direction to the left.
MATRIX = "-1 0 0 0 0 1 0 0 0 0 -1 9 0 0 0 1"
MIRRORED = "1 0 0 0 0 1 0 0 0 0 -1 9 0 0 0 1"
BALL = """<shape type="sphere"><point name="center" value="1, 2, 3"/><float name="radius" value="2"/>
<ref id="glass_2"/></shape>"""


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def written(self, matrix=MATRIX, more="", **options):
        """The properties of the scene, by name."""
        with open(self.path("small.xml"), "w", encoding="utf-8") as file:
            file.write(SCENE.format(matrix=matrix, more=more))
        with open(write_luxcore(self.path("small.xml"), **options), encoding="utf-8") as file:
            return dict(line.rstrip("\n").split(" = ") for line in file)

    def expect_problem(self, words, **parts):
        with self.assertRaises(Problem) as caught:
            self.written(**parts)
        self.assertIn(words, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))


class Writer(InFolder):
    def test_the_camera_looks_along_the_third_column_and_its_window_is_one_row_lower(self):
        found = self.written()
        self.assertEqual(found["scene.camera.lookat.orig"], "0.0 0.0 9.0")
        self.assertEqual(found["scene.camera.lookat.target"], "0.0 0.0 8.0")
        self.assertEqual(found["scene.camera.up"], "0.0 1.0 0.0")
        left, right, bottom, top = map(float, found["scene.camera.screenwindow"].split())
        self.assertEqual((left, right), (-1, 1))
        self.assertAlmostEqual(top - bottom, 2 * 16 / 24)
        self.assertAlmostEqual(top + bottom, -2 * (2 * 16 / 24) / 16)

    def test_surfaces_have_their_colours_and_lamps_their_radiance(self):
        found = self.written()
        self.assertEqual(found["scene.materials.white_0.kd"], "0.25 0.5 0.75")
        self.assertEqual(found["scene.materials.lamp_1.emission"], "4.0 5.0 6.0")
        self.assertEqual(found["scene.materials.lamp_1.emission.power"], "0")
        self.assertEqual(found["scene.objects.o1.material"], '"lamp_1"')
        self.assertNotIn("scene.materials.white_0.emission", found)

    def test_a_point_light_has_its_intensity_times_the_solid_angle_that_luxcore_divides_by(self):
        colour = [float(each) for each in self.written()["scene.lights.l0.color"].split()]
        for value, intensity in zip(colour, (1, 2, 4)):
            self.assertAlmostEqual(value, 4 * math.pi * intensity)

    def test_spheres_are_refused_or_become_meshes(self):
        self.expect_problem("no exact spheres", more=BALL)
        found = self.written(more=BALL, spheres=True)
        self.assertTrue(os.path.getsize(found["scene.objects.o2.ply"].strip('"')) > 1e6)
        self.assertEqual(found["scene.materials.glass_2.interiorior"], "1.5")

    def test_what_it_does_not_know_is_an_error(self):
        self.expect_problem("mirrored", matrix=MIRRORED)
        self.expect_problem("spot", more='<emitter type="spot"/>')
        self.expect_problem("cube", more='<shape type="cube"><ref id="white_0"/></shape>')
        self.expect_problem("no radius", spheres=True, more='<shape type="sphere"><point name="center" value="1, 2, 3"/>'
                            '<ref id="glass_2"/></shape>')


class Sphere(unittest.TestCase):
    def test_is_closed_points_outwards_and_has_the_area_of_the_sphere(self):
        center, radius = (1.0, 2.0, 3.0), 2.0
        points, _, faces = sphere(center, radius, 8)
        edges = Counter((face[i], face[(i + 1) % 3]) for face in faces for i in range(3))
        self.assertEqual(set(edges.values()), {1})
        self.assertTrue(all((b, a) in edges for a, b in edges))
        area = 0.0
        for a, b, c in ([points[corner] for corner in face] for face in faces):
            u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
            normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            self.assertGreater(sum(normal[i] * (a[i] - center[i]) for i in range(3)), 0)
            area += 0.5 * math.hypot(*normal)
        self.assertAlmostEqual(area, 4 * math.pi * radius**2)


class Settings(unittest.TestCase):
    def test_the_threads_of_two_pictures_have_different_seeds(self):
        seeds = [luxcore_settings.settings("PATHCPU", 64, 64, 6, 128, seed)["renderengine.seed"] for seed in (0, 1)]
        self.assertGreaterEqual(seeds[0], 1)
        self.assertGreater(seeds[1] - seeds[0], 128)


class Pfm(InFolder):
    def test_is_read(self):
        with open(self.path("one.pfm"), "wb") as file:
            file.write(b"PF\n1 1\n-1.0\n" + array.array("f", [1.0, 2.0, 3.0]).tobytes())
        self.assertEqual(list(read_pfm(self.path("one.pfm"))), [1.0, 2.0, 3.0])


if __name__ == "__main__":
    unittest.main()
