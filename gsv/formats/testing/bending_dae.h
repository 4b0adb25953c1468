// A COLLADA file of two triangles. Bone A has the triangle at the origin. Bone B has the other
// triangle, above and beside the first one. B's joint is at z = 1 and rotates from 0 to 90 degrees
// about x in 1 s.
#pragma once

namespace gsv::formats {

inline constexpr char kBendingDae[] = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="g" name="g"><mesh>
    <source id="p"><float_array id="pa" count="18">0 0 0 1 0 0 0 0 1 2 0 1 3 0 1 2 0 2</float_array>
      <technique_common><accessor source="#pa" count="6" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
    </source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/>
      <p>0 1 2 3 4 5</p></triangles>
  </mesh></geometry></library_geometries>
  <library_controllers><controller id="c"><skin source="#g">
    <bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
    <source id="j"><Name_array id="ja" count="2">A B</Name_array>
      <technique_common><accessor source="#ja" count="2" stride="1">
        <param name="JOINT" type="name"/></accessor></technique_common></source>
    <source id="b"><float_array id="ba" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1
      1 0 0 0 0 1 0 0 0 0 1 -1 0 0 0 1</float_array>
      <technique_common><accessor source="#ba" count="2" stride="16">
        <param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
    <source id="w"><float_array id="wa" count="1">1</float_array>
      <technique_common><accessor source="#wa" count="1" stride="1">
        <param name="WEIGHT" type="float"/></accessor></technique_common></source>
    <joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#b"/>
    </joints>
    <vertex_weights count="6"><input semantic="JOINT" source="#j" offset="0"/>
      <input semantic="WEIGHT" source="#w" offset="1"/>
      <vcount>1 1 1 1 1 1</vcount><v>0 0 0 0 0 0 1 0 1 0 1 0</v></vertex_weights>
  </skin></controller></library_controllers>
  <library_animations><animation id="a">
    <source id="t"><float_array id="ta" count="2">0 1</float_array>
      <technique_common><accessor source="#ta" count="2" stride="1">
        <param name="TIME" type="float"/></accessor></technique_common></source>
    <source id="o"><float_array id="oa" count="32">1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 1
      1 0 0 0 0 0 -1 0 0 1 0 1 0 0 0 1</float_array>
      <technique_common><accessor source="#oa" count="2" stride="16">
        <param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
    <source id="i"><Name_array id="ia" count="2">LINEAR LINEAR</Name_array>
      <technique_common><accessor source="#ia" count="2" stride="1">
        <param name="INTERPOLATION" type="name"/></accessor></technique_common></source>
    <sampler id="s"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#o"/>
      <input semantic="INTERPOLATION" source="#i"/></sampler>
    <channel source="#s" target="B/transform"/>
  </animation></library_animations>
  <library_visual_scenes><visual_scene id="scene" name="scene">
    <node id="A" name="A" sid="A" type="JOINT">
      <matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
      <node id="B" name="B" sid="B" type="JOINT">
        <matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 1</matrix></node>
    </node>
    <node id="body" type="NODE"><instance_controller url="#c"><skeleton>#A</skeleton>
    </instance_controller></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
)";

}  // namespace gsv::formats
