#!/usr/bin/env python3
"""mesh.py TRIANGLES FILE: writes a sphere with bumps as COLLADA, with its triangles in random order.

The scenes of the repository are too small to keep a GPU busy while it builds their trees.
"""
import math
import random
import sys

HEAD = """<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <created>2026-11-27T00:00:00</created>
    <modified>2026-11-27T00:00:00</modified>
    <up_axis>Z_UP</up_axis>
  </asset>
  <library_geometries>
    <geometry id="sphere">
      <mesh>
        <source id="positions">
          <float_array id="numbers" count="{numbers}">{positions}</float_array>
          <technique_common>
            <accessor source="#numbers" count="{points}" stride="3">
              <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="vertices">
          <input semantic="POSITION" source="#positions"/>
        </vertices>
        <triangles count="{triangles}">
          <input semantic="VERTEX" source="#vertices" offset="0"/>
          <p>{indices}</p>
        </triangles>
      </mesh>
    </geometry>
  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene">
      <node id="node"><instance_geometry url="#sphere"/></node>
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"""


def collada(wanted):
    """A grid of n by n cells over the two angles, without the degenerate triangles at the poles."""
    n = max(3, round(math.sqrt(wanted / 2)) + 1)
    positions = []
    for i in range(n + 1):
        theta = math.pi * i / n
        for j in range(n):
            phi = 2 * math.pi * j / n
            r = 1 + 0.1 * math.sin(9 * theta) * math.cos(7 * phi)
            ring = r * math.sin(theta)
            positions.append("%.7g %.7g %.7g" % (ring * math.cos(phi), ring * math.sin(phi), r * math.cos(theta)))
    triangles = []
    for i in range(n):
        for j in range(n):
            a, b = i * n + j, i * n + (j + 1) % n
            if i + 1 < n:
                triangles.append("%d %d %d" % (a, a + n, b + n))
            if i > 0:
                triangles.append("%d %d %d" % (a, b + n, b))
    random.Random(1).shuffle(triangles)  # no builder profits from the order in the file
    return HEAD.format(numbers=3 * len(positions), points=len(positions), positions=" ".join(positions),
                       triangles=len(triangles), indices=" ".join(triangles))


if __name__ == "__main__":
    if len(sys.argv) != 3 or not sys.argv[1].isdigit():
        sys.exit("mesh.py: expected TRIANGLES FILE")
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(collada(int(sys.argv[1])))
