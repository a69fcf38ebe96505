"""The reader of COLLADA files and the writers, on small scenes."""

import array
import math
import os
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from collada import read_scene
from plumbline import read_pfm
from problem import Problem
from scene import frame_camera
from write_luxcore import write_luxcore
from write_mitsuba import write_mitsuba

EFFECT = """<effect id="{name}-effect"><profile_COMMON><technique sid="common"><lambert>
  <diffuse><color>0.25 0.5 0.75 1</color></diffuse></lambert></technique></profile_COMMON>{extra}</effect>"""
LAMP = '<extra><technique profile="CMU462"><emission><radiance>4 5 6</radiance></emission></technique></extra>'
GLASS = """<extra><technique profile="CMU462"><glass><reflectance>1 1 1</reflectance>
  <transmittance>0.5 0.5 0.5</transmittance><roughness>0</roughness><ior>1.5</ior></glass></technique></extra>"""
SQUARE = "0 0 0  1 0 0  1 1 0  0 1 0"
BIND = """<bind_material><technique_common>{instances}</technique_common></bind_material>"""

SCENE = """<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_cameras><camera id="camera"><optics><technique_common><perspective><xfov>90</xfov></perspective>
</technique_common></optics></camera></library_cameras>
<library_effects>{effects}</library_effects>
<library_materials>{materials}</library_materials>
<library_geometries><geometry id="mesh"><mesh><source id="positions"><float_array id="numbers" count="12">{square}
</float_array><technique_common><accessor source="#numbers" count="4" stride="3"/></technique_common></source>
<vertices id="vertices"><input semantic="POSITION" source="#positions"/></vertices>
<polylist material="white" count="1"><input semantic="VERTEX" source="#vertices" offset="0"/>
<vcount>4</vcount><p>0 1 2 3</p></polylist>
<triangles material="lamp" count="1"><input semantic="VERTEX" source="#vertices" offset="1"/>
<input semantic="NORMAL" source="#positions" offset="0"/><p>9 0 9 2 9 1</p></triangles></mesh></geometry>
<geometry id="ball"><extra><technique profile="CMU462"><sphere><radius>0.5</radius></sphere></technique></extra>
</geometry></library_geometries>
<library_visual_scenes><visual_scene id="all">
<node><translate>0 0 9</translate><instance_camera url="#camera"/></node>
<node>{transform}<instance_geometry url="#mesh">{mesh}</instance_geometry></node>{more}
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#all"/></scene></COLLADA>"""

SPHERE = '<node><translate>1 2 3</translate><scale>2 2 2</scale><instance_geometry url="#ball">{0}</instance_geometry></node>'


def bound(*names):
    return BIND.format(instances="".join(f'<instance_material symbol="{name}" target="#{name}"/>' for name in names))


def text(square=SQUARE, transform="", more=""):
    kinds = {"white": "", "lamp": LAMP, "glass": GLASS}
    return SCENE.format(
        effects="".join(EFFECT.format(name=name, extra=extra) for name, extra in kinds.items()),
        materials="".join(f'<material id="{name}"><instance_effect url="#{name}-effect"/></material>' for name in kinds),
        square=square, transform=transform, more=more, mesh=bound("white", "lamp"))


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def read(self, **parts):
        with open(self.path("small.dae"), "w", encoding="utf-8") as file:
            file.write(text(**parts))
        return read_scene(self.path("small.dae"))

    def expect_problem(self, words, **parts):
        with self.assertRaises(Problem) as caught:
            self.read(**parts)
        self.assertIn(words, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))


class Reader(InFolder):
    def test_reads_triangles_materials_and_camera(self):
        scene = self.read()
        self.assertEqual([each.kind for each in scene.materials], ["lambertian", "emission"])
        self.assertEqual(scene.materials[0].color, (0.25, 0.5, 0.75))
        self.assertEqual(scene.triangles[0], [((0, 0, 0), (1, 0, 0), (1, 1, 0)), ((0, 0, 0), (1, 1, 0), (0, 1, 0))])
        self.assertEqual(scene.triangles[1], [((0, 0, 0), (1, 1, 0), (1, 0, 0))])
        self.assertEqual((scene.camera.eye, scene.camera.fov, scene.camera.fov_axis), ((0, 0, 9), 90, "x"))

    def test_a_mirroring_transform_keeps_the_front(self):
        lamp = self.read(transform="<scale>1 1 -1</scale>").triangles[1][0]
        self.assertEqual(lamp, ((0, 0, 0), (1, 0, 0), (1, 1, 0)))

    def test_transforms_apply_in_order(self):
        scene = self.read(transform="<translate>5 0 0</translate><rotate>0 0 1 90</rotate><scale>2 2 2</scale>")
        for value, expected in zip(scene.triangles[0][0][1], (5, 2, 0)):
            self.assertAlmostEqual(value, expected)

    def test_spheres_are_scaled(self):
        scene = self.read(more=SPHERE.format(bound("glass")))
        (center, radius, material), = scene.spheres
        self.assertEqual((center, radius), ((1, 2, 3), 1.0))
        self.assertEqual((scene.materials[material].kind, scene.materials[material].ior), ("glass", 1.5))

    def test_framing_moves_the_eye(self):
        scene = self.read()
        frame_camera(scene)
        for value, expected in zip(scene.camera.eye, (0.5, 0.5, 1.5 * math.sqrt(2))):
            self.assertAlmostEqual(value, expected)

    def test_what_it_does_not_know_is_an_error(self):
        self.expect_problem("not convex", square="0 0 0  1 0 0  0.1 0.1 0  0 1 0")
        self.expect_problem("not supported here", transform="<skew>1 1 0 0 0 1 0</skew>")
        self.expect_problem("refers to #sun", more='<node><instance_light url="#sun"/></node>')
        self.expect_problem("16 numbers expected", transform="<matrix>1 2</matrix>")


class Writers(InFolder):
    def test_mitsuba_gets_all_surfaces_and_no_roulette(self):
        scene = self.read(more=SPHERE.format(bound("glass")))
        root = ElementTree.parse(write_mitsuba(scene, self.folder.name, 24, 16, 6)).getroot()
        self.assertEqual([shape.get("type") for shape in root.findall("shape")], ["ply", "ply", "sphere"])
        integrator = {each.get("name"): int(each.get("value")) for each in root.find("integrator")}
        self.assertEqual(integrator["max_depth"], 6)
        self.assertGreater(integrator["rr_depth"], 6)
        self.assertEqual(root.find("shape/emitter/rgb").get("value"), "4.0, 5.0, 6.0")
        with open(self.path("small_0.ply"), "rb") as file:
            header, data = file.read().split(b"end_header\n")
        self.assertIn(b"element vertex 4\n", header)
        self.assertEqual(len(data), 4 * 12 + 2 * 13)

    def test_luxcore_gets_triangles_and_refuses_spheres(self):
        with open(write_luxcore(self.read(), self.folder.name, 24, 16), encoding="utf-8") as file:
            lines = file.read()
        self.assertIn("scene.materials.m1.emission = 4.0 5.0 6.0\n", lines)
        with self.assertRaises(Problem):
            write_luxcore(self.read(more=SPHERE.format(bound("glass"))), self.folder.name, 24, 16)

    def test_pfm_is_read(self):
        with open(self.path("one.pfm"), "wb") as file:
            file.write(b"PF\n1 1\n-1.0\n" + array.array("f", [1.0, 2.0, 3.0]).tobytes())
        self.assertEqual(list(read_pfm(self.path("one.pfm"))), [1.0, 2.0, 3.0])


if __name__ == "__main__":
    unittest.main()
