#pragma once

// The text of scenes/mesh_knot.dae without the numbers of the knot: a {word} takes the place of each of
// them.

#include <string_view>

constexpr std::string_view frame = R"dae(<?xml version="1.0" encoding="utf-8"?>
<!--
  A rope along a torus knot, in a lit room. Written by generate/mesh_knot.cpp; change that, not this.

  Why       A mesh large enough that a tree over its triangles matters: curved, closed, its strands close to
            each other and slanted to every axis. What everything else here lacks.
  Requires  shapes triangle; bsdfs lambertian; emitters mesh; fov horizontal

  Knot      {faces} triangles on {vertices} shared vertices, a closed torus wound counter-clockwise seen
            from outside. The node scales it by 0.28, tilts and lifts it. In its own units it encloses
            a volume of 24.94309 and has an area of 106.31998.
  Room      |x| <= 1.6, -1.2 <= y <= 1.4, 0 <= z <= 2.4, open in front; 18 triangles.
  Luminaire [-0.7, 0.5] x [-0.6, 0.2] at z = 2.4, flush with the ceiling, facing down, L = (11, 10, 8.5).
  Camera    eye (0, -5.2, 1.2), looking along +y: a picture of 4:3 sees the room and nothing else.

  Closed form, direct light (Lambert's polygon formula, as in cornell_diffuse.dae) at the floor point
  (1.3, -1, 0), which the knot does not shadow:
    E = 0.079383661 L,  Lo at 2 edges = (0.19456825, 0.17688023, 0.15034819)

  Makes visible: trees that lose primitives or rays, pinholes between triangles (light inside the rope),
  shadow rays that leave a triangle and meet its neighbour.
-->
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <created>2026-11-22T00:00:00</created>
    <modified>2026-11-22T00:00:00</modified>
    <up_axis>Z_UP</up_axis>
  </asset>
  <library_cameras>
    <camera id="camera">
      <optics>
        <technique_common>
          <perspective>
            <xfov>43</xfov>
          </perspective>
        </technique_common>
      </optics>
    </camera>
  </library_cameras>
  <library_effects>
    <effect id="wall-effect">
      <profile_COMMON>
        <technique sid="common">
          <lambert>
            <diffuse><color>0.7 0.7 0.7 1</color></diffuse>
          </lambert>
        </technique>
      </profile_COMMON>
    </effect>
    <effect id="green-effect">
      <profile_COMMON>
        <technique sid="common">
          <lambert>
            <diffuse><color>0.25 0.5 0.2 1</color></diffuse>
          </lambert>
        </technique>
      </profile_COMMON>
    </effect>
    <effect id="ochre-effect">
      <profile_COMMON>
        <technique sid="common">
          <lambert>
            <diffuse><color>0.65 0.45 0.15 1</color></diffuse>
          </lambert>
        </technique>
      </profile_COMMON>
    </effect>
    <effect id="rope-effect">
      <profile_COMMON>
        <technique sid="common">
          <lambert>
            <diffuse><color>0.75 0.4 0.3 1</color></diffuse>
          </lambert>
        </technique>
      </profile_COMMON>
    </effect>
    <effect id="luminaire-effect">
      <profile_COMMON>
        <technique sid="common">
          <lambert/>
        </technique>
      </profile_COMMON>
      <extra>
        <technique profile="CMU462">
          <emission>
            <radiance>11 10 8.5</radiance>
          </emission>
        </technique>
      </extra>
    </effect>
  </library_effects>
  <library_materials>
    <material id="wall"><instance_effect url="#wall-effect"/></material>
    <material id="green"><instance_effect url="#green-effect"/></material>
    <material id="ochre"><instance_effect url="#ochre-effect"/></material>
    <material id="rope"><instance_effect url="#rope-effect"/></material>
    <material id="luminaire"><instance_effect url="#luminaire-effect"/></material>
  </library_materials>
  <library_geometries>
    <geometry id="room">
      <mesh>
        <!-- 0 to 3: floor; 4 to 7: ceiling above them; 8 to 11: corners of the luminaire -->
        <source id="room-positions">
          <float_array id="room-numbers" count="36">
            -1.6 -1.2 0  1.6 -1.2 0  1.6 1.4 0  -1.6 1.4 0
            -1.6 -1.2 2.4  1.6 -1.2 2.4  1.6 1.4 2.4  -1.6 1.4 2.4
            -0.7 -0.6 2.4  0.5 -0.6 2.4  0.5 0.2 2.4  -0.7 0.2 2.4
          </float_array>
          <technique_common>
            <accessor source="#room-numbers" count="12" stride="3">
              <param name="X" type="float"/>
              <param name="Y" type="float"/>
              <param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="room-vertices">
          <input semantic="POSITION" source="#room-positions"/>
        </vertices>
        <!-- floor, back wall, and the ceiling around the luminaire -->
        <polylist material="wall" count="6">
          <input semantic="VERTEX" source="#room-vertices" offset="0"/>
          <vcount>4 4 4 4 4 4</vcount>
          <p>0 1 2 3  3 2 6 7  4 8 9 5  5 9 10 6  6 10 11 7  7 11 8 4</p>
        </polylist>
        <polylist material="green" count="1">
          <input semantic="VERTEX" source="#room-vertices" offset="0"/>
          <vcount>4</vcount>
          <p>0 3 7 4</p>
        </polylist>
        <polylist material="ochre" count="1">
          <input semantic="VERTEX" source="#room-vertices" offset="0"/>
          <vcount>4</vcount>
          <p>2 1 5 6</p>
        </polylist>
        <polylist material="luminaire" count="1">
          <input semantic="VERTEX" source="#room-vertices" offset="0"/>
          <vcount>4</vcount>
          <p>8 11 10 9</p>
        </polylist>
      </mesh>
    </geometry>
    <geometry id="knot">
      <mesh>
        <!-- one line per ring -->
        <source id="knot-positions">
          <float_array id="knot-numbers" count="{coordinates}">
{positions}
          </float_array>
          <technique_common>
            <accessor source="#knot-numbers" count="{vertices}" stride="3">
              <param name="X" type="float"/>
              <param name="Y" type="float"/>
              <param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="knot-vertices">
          <input semantic="POSITION" source="#knot-positions"/>
        </vertices>
        <triangles material="rope" count="{faces}">
          <input semantic="VERTEX" source="#knot-vertices" offset="0"/>
          <p>
{triangles}
          </p>
        </triangles>
      </mesh>
    </geometry>
  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene">
      <node id="camera-node">
        <translate>0 -5.2 1.2</translate>
        <rotate>1 0 0 90</rotate>
        <instance_camera url="#camera"/>
      </node>
      <node id="room-node">
        <instance_geometry url="#room">
          <bind_material>
            <technique_common>
              <instance_material symbol="wall" target="#wall"/>
              <instance_material symbol="green" target="#green"/>
              <instance_material symbol="ochre" target="#ochre"/>
              <instance_material symbol="luminaire" target="#luminaire"/>
            </technique_common>
          </bind_material>
        </instance_geometry>
      </node>
      <node id="knot-node">
        <translate>0 0.1 1.12</translate>
        <rotate>0 0 1 20</rotate>
        <rotate>1 0 0 70</rotate>
        <scale>0.28 0.28 0.28</scale>
        <instance_geometry url="#knot">
          <bind_material>
            <technique_common>
              <instance_material symbol="rope" target="#rope"/>
            </technique_common>
          </bind_material>
        </instance_geometry>
      </node>
    </visual_scene>
  </library_visual_scenes>
  <scene>
    <instance_visual_scene url="#scene"/>
  </scene>
</COLLADA>
)dae";
