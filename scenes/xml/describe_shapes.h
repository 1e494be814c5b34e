// Shapes as a scene file has them (describe_bsdfs.h says how). Of every plugin the parser and the writer themselves do
// what ShapeDescription has beside the geometry.
#pragma once

#include "scenes/description/description.h"
#include "scenes/xml/param_type.h"

namespace photonproof {

template <class P>
void describe_placed_shape(P& p) {
  p.also("to_world", scene_xml::ParamType::transform, "", "places the shape; it has an inverse");
  p.also("flip_normals", scene_xml::ParamType::boolean, "false", "the front is the other side");
  p.nested("bsdf", 1, "a BSDF, else `diffuse`");
  p.nested("emitter", 1, "an `area`");
  p.nested("medium", 2, "media named `interior` and `exterior`");
}

template <class P>
void describe(P& p, SphereDescription& d) {
  p.plugin("sphere", "normals outward; to_world turns, moves and scales evenly");
  p.point("center", d.center, "before to_world");
  p.positive("radius", d.radius, "before to_world");
  describe_placed_shape(p);
}

template <class P>
void describe(P& p, RectangleDescription&) {
  p.plugin("rectangle", "[-1,1]^2 in the local xy plane, normal +z");
  describe_placed_shape(p);
}

template <class P>
void describe(P& p, DiskDescription&) {
  p.plugin("disk", "the unit disc in the local xy plane, normal +z; to_world leaves it a circle");
  describe_placed_shape(p);
}

template <class P>
void describe(P& p, CubeDescription&) {
  p.plugin("cube", "[-1,1]^3, normals outward");
  describe_placed_shape(p);
}

template <class P>
void describe(P& p, CylinderDescription& d) {
  p.plugin("cylinder", "open at both ends, normals outward; to_world turns, moves and scales evenly");
  p.point("p0", d.p0, "one end of its axis");
  p.point("p1", d.p1, "the other");
  p.positive("radius", d.radius, "before to_world");
  describe_placed_shape(p);
}

template <class P>
void describe(P& p, PlaneDescription&) {
  p.plugin("plane", "extension: the whole local xy plane, normal +z; it does not emit");
  describe_placed_shape(p);
}

template <class P>
void describe(P& p, MeshDescription& d) {
  const bool is_ply = d.format == MeshDescription::Format::ply;
  p.plugin(is_ply ? "ply" : "obj", "triangles of a file");
  p.file("filename", d.filename, is_ply ? "the name of a PLY file" : "the name of an OBJ file");
  p.boolean("face_normals", d.face_normals, "shades flat, without normals of vertices");
  p.boolean("flip_tex_coords", d.flip_tex_coords, "v becomes 1 - v");
  describe_placed_shape(p);
}

template <class P>
void describe(P& p, HeightfieldDescription& d) {
  p.plugin("heightfield",
           "extension: z(x, y) over [-1,1]^2 of the local xy plane, at most 2^24 cells of two triangles");
  p.integer("columns", d.columns, 1, 1 << 20, "cells along x");
  p.integer("rows", d.rows, 1, 1 << 20, "cells along y");
  p.number("amplitude", d.amplitude, scene_xml::kAny, "factor of the heights");
  p.boolean("face_normals", d.face_normals, "shades flat, without normals of vertices");
  p.texture_or("height", d.height,
               "its mean channel is the height; without, gradient noise in +-1:", [&](HeightfieldNoise& noise) {
                 p.number("frequency_x", noise.frequency_x, {0, 1e6}, "cells of the noise per local unit");
                 p.number("frequency_y", noise.frequency_y, {0, 1e6}, "cells of the noise per local unit");
                 p.integer("octaves", noise.octaves, 1, 16, "each of half the height and twice the frequency");
                 p.integer("seed", noise.seed, 0, 4294967295, "");
               });
  describe_placed_shape(p);
}

template <class P>
void describe(P& p, InstanceDescription& d) {
  p.plugin("instance", "a copy of a shape group");
  p.shape_group(d.group, "a <ref> to a shapegroup");
  p.also("to_world", scene_xml::ParamType::transform, "", "places the copy; it has an inverse");
}

}  // namespace photonproof
