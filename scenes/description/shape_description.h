// Shapes as a scene file states them. The parser and the writer handle the members of ShapeDescription other than the
// geometry themselves, for every plugin.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/curves/curve_set.h"
#include "scenes/description/texture_description.h"
#include "scenes/ellipsoids/ellipsoid_cloud.h"
#include "scenes/ellipsoids/shell.h"
#include "scenes/meshes/mesh.h"
#include "scenes/meshes/vol.h"

namespace photonproof::inline scenes_description {

/// Before `to_world`: centre and radius. `to_world` must be a similarity; the normal points outward.
struct SphereDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  Vec3d center{0, 0, 0};
  double radius = 1;
  friend bool operator==(const SphereDescription&, const SphereDescription&) = default;
};

/// Shapes that can neither emit nor hold media.
template <class P>
void describe_passive_shape(P& p) {
  p.also("to_world", scene_xml::ParamType::transform, "", "places the shape; it has an inverse");
  p.also("flip_normals", scene_xml::ParamType::boolean, "false", "the front is the other side");
  p.nested("bsdf", 1, "a BSDF, else `diffuse`");
}

template <class P>
void describe_placed_shape(P& p) {
  describe_passive_shape(p);
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

/// Flat shapes.
template <class P>
void describe_flat_shape(P& p) {
  describe_passive_shape(p);
  p.nested("emitter", 1, "an `area` or `directionalarea`");
  p.nested("sensor", 1, "an `irradiancemeter`");
  p.nested("medium", 2, "media named `interior` and `exterior`");
}

/// [-1,1]^2 in the local xy plane, normal +z.
struct RectangleDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  friend bool operator==(const RectangleDescription&, const RectangleDescription&) = default;
};

template <class P>
void describe(P& p, RectangleDescription&) {
  p.plugin("rectangle", "[-1,1]^2 in the local xy plane, normal +z");
  describe_flat_shape(p);
}

/// The unit disc in the local xy plane, normal +z; an ellipse where `to_world` scales unevenly.
struct DiskDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  friend bool operator==(const DiskDescription&, const DiskDescription&) = default;
};

template <class P>
void describe(P& p, DiskDescription&) {
  p.plugin("disk", "the unit disc in the local xy plane, normal +z");
  describe_flat_shape(p);
}

/// [-1,1]^3, normals outward.
struct CubeDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 6;
  friend bool operator==(const CubeDescription&, const CubeDescription&) = default;
};

template <class P>
void describe(P& p, CubeDescription&) {
  p.plugin("cube", "[-1,1]^3, normals outward");
  describe_placed_shape(p);
}

/// The curved side of a cylinder from p0 to p1, open at both ends, normals outward. `to_world` must be a similarity:
/// the parser moves p1 where a file's scales along the axis alone.
struct CylinderDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  Vec3d p0{0, 0, 0}, p1{0, 0, 1};
  double radius = 1;
  friend bool operator==(const CylinderDescription&, const CylinderDescription&) = default;
};

template <class P>
void describe(P& p, CylinderDescription& d) {
  p.plugin("cylinder", "open at both ends, normals outward; to_world scales evenly across the axis");
  p.point("p0", d.p0, "one end of its axis");
  p.point("p1", d.p1, "the other");
  p.positive("radius", d.radius, "before to_world");
  describe_placed_shape(p);
}

/// Extension: the whole local xy plane, normal +z; uv = local xy.
struct PlaneDescription {
  static constexpr bool finite = false;
  static constexpr int surfaces = 1;
  friend bool operator==(const PlaneDescription&, const PlaneDescription&) = default;
};

template <class P>
void describe(P& p, PlaneDescription&) {
  p.plugin("plane", "extension: the whole local xy plane, normal +z; it does not emit");
  describe_placed_shape(p);
}

/// A mesh of triangles. Before to_world a triangle's normal is on the side that sees its corners counter-clockwise. A
/// to_world that mirrors the mesh keeps that side, as in Mitsuba 3.10. Unless `face_normals`, shading interpolates
/// the mesh's vertex normals (transformed by the inverse transpose, normalised). Mitsuba computes missing ones as the
/// mean of the adjoining triangles' normals, weighted by their angles at the vertex (Thuermer and Wuethrich 1998). The
/// values here are the file's.
struct MeshDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  enum class Format { ply, obj, serialized };
  Format format = Format::ply;
  std::string filename;  ///< as the scene spells it
  bool face_normals = false;
  bool flip_tex_coords = false;              ///< v becomes 1 - v. OBJ files default to true, PLY files to false.
  std::shared_ptr<const TriangleMesh> mesh;  ///< Never null; shared by the shapes that name the same file.
  int shape_index = 0;                       ///< which mesh of a serialized file
  friend bool operator==(const MeshDescription& a, const MeshDescription& b) {
    return a.format == b.format && a.filename == b.filename && a.shape_index == b.shape_index &&
           a.face_normals == b.face_normals && a.flip_tex_coords == b.flip_tex_coords &&
           (a.mesh == b.mesh || (a.mesh && b.mesh && *a.mesh == *b.mesh));
  }
};

template <class P>
void describe(P& p, MeshDescription& d) {
  constexpr const char* names[] = {"ply", "obj", "serialized"};  // in the order of Format
  constexpr const char* files[] = {"the name of a PLY file", "the name of an OBJ file",
                                   "the name of a file of Mitsuba 0.6"};
  const auto format = static_cast<std::size_t>(d.format);
  p.plugin(names[format], "triangles of a file");
  p.file("filename", d.filename, files[format]);
  if (d.format == MeshDescription::Format::serialized)
    p.integer("shape_index", d.shape_index, 0, 1 << 30, "number of the mesh in the file");
  p.boolean("face_normals", d.face_normals, "shades flat, without normals of vertices");
  p.boolean("flip_tex_coords", d.flip_tex_coords, "v becomes 1 - v");
  describe_placed_shape(p);
}

struct HeightfieldNoise {
  double frequency_x = 1, frequency_y = 1;  ///< lattice cells per local unit
  int octaves = 1;                          ///< each twice the frequency and half the height of the one before
  std::uint32_t seed = 0;
  friend bool operator==(const HeightfieldNoise&, const HeightfieldNoise&) = default;
};

/// Extension: z(x, y) over [-1,1]^2 of the local xy plane, columns x rows cells of two triangles, uv over the square.
/// Heights come from a bitmap (its mean channel times `amplitude`) or from gradient noise in +-amplitude.
struct HeightfieldDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  using Noise = HeightfieldNoise;
  int columns = 64, rows = 64;
  double amplitude = 1;
  bool face_normals = false;
  std::variant<Noise, TextureIndex> height;
  friend bool operator==(const HeightfieldDescription&, const HeightfieldDescription&) = default;
};

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

/// Tubes around the curves of a file, with normals outward. Rays that meet a tube from inside pass, as in Mitsuba.
/// Control points are placed by to_world, and their radii stay. A B-spline curve has four points or more and open ends.
/// Its surface is made of circles across the curve. A linear curve has two points or more. Its surface is that around
/// all balls whose centres and radii lie on a segment.
struct CurvesDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  enum class Basis { bspline, linear };
  Basis basis = Basis::bspline;
  std::string filename;                    ///< as the scene spells it
  std::shared_ptr<const CurveSet> curves;  ///< Never null; shared by the shapes that name the same file.
  double radius_scale = 1;                 ///< factor on radii, of a scene whose lengths were scaled

  std::size_t points_of_segment() const { return basis == Basis::linear ? 2 : 4; }
  friend bool operator==(const CurvesDescription& a, const CurvesDescription& b) {
    return a.basis == b.basis && a.filename == b.filename && a.radius_scale == b.radius_scale &&
           (a.curves == b.curves || (a.curves && b.curves && *a.curves == *b.curves));
  }
};

template <class P>
void describe(P& p, CurvesDescription& d) {
  const bool linear = d.basis == CurvesDescription::Basis::linear;
  p.plugin(linear ? "linearcurve" : "bsplinecurve",
           linear ? "tubes around polylines, with round joints and ends; only their outside is seen"
                  : "tubes around cubic B-splines, open at both ends; only their outside is seen");
  p.file("filename", d.filename,
         linear ? "text: lines of `x y z radius`, at least 2 a curve, blank lines between curves"
                : "text: lines of `x y z radius`, at least 4 a curve, blank lines between curves");
  describe_passive_shape(p);
}

/// The zeros of signed distances on a grid over the unit cube, interpolated trilinearly. The samples of n along an axis
/// lie at i / (n - 1). The front is where distances are positive.
struct SdfGridDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  enum class Normals { smooth, analytic };
  std::string filename;                    ///< as the scene spells it
  std::shared_ptr<const VolumeGrid> grid;  ///< Never null; one channel, at least two samples along each axis.
  Normals normals = Normals::smooth;
  friend bool operator==(const SdfGridDescription& a, const SdfGridDescription& b) {
    return a.filename == b.filename && a.normals == b.normals &&
           (a.grid == b.grid || (a.grid && b.grid && *a.grid == *b.grid));
  }
};

template <class P>
void describe(P& p, SdfGridDescription& d) {
  p.plugin("sdfgrid", "zeros of signed distances over the unit cube; sample i of n lies at i / (n - 1)");
  p.file("filename", d.filename, "the name of a .vol file of one channel");
  p.choice("normals", d.normals,
           {{"smooth", SdfGridDescription::Normals::smooth}, {"analytic", SdfGridDescription::Normals::analytic}},
           "normals of shading: continuous across voxels, or the gradient");
  describe_passive_shape(p);
  p.nested("medium", 2, "media named `interior` and `exterior`");
}

/// The ellipsoids of a file, or triangulated shells around them. Rays that meet one from inside pass, as in Mitsuba. Of
/// a to_world that is not a similarity only the turn and the mean scale apply to an ellipsoid's axes.
struct EllipsoidsDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  std::string filename;                         ///< as the scene spells it
  std::shared_ptr<const EllipsoidCloud> cloud;  ///< Never null; shared by the shapes that name the same file.
  bool triangles = false;                       ///< shells instead of ellipsoids
  Shell shell = Shell::usual;
  double scale_factor = 1;
  double extent = 3;  ///< semi-axes in terms of the file's scales
  /// The extent is multiplied by sqrt(2 ln(100 opacity)) / 3: the surface is where a Gaussian's response is 1 %.
  bool adapts_extent = false;

  /// Semi-axes of an ellipsoid in terms of its scales; 0 where none of it is left. Without opacities they do not adapt.
  double reach(std::size_t i) const;
  friend bool operator==(const EllipsoidsDescription& a, const EllipsoidsDescription& b) {
    return a.filename == b.filename && a.triangles == b.triangles && a.shell == b.shell &&
           a.scale_factor == b.scale_factor && a.extent == b.extent && a.adapts_extent == b.adapts_extent &&
           (a.cloud == b.cloud || (a.cloud && b.cloud && *a.cloud == *b.cloud));
  }
};

template <class P>
void describe(P& p, EllipsoidsDescription& d) {
  p.plugin(d.triangles ? "ellipsoidsmesh" : "ellipsoids",
           d.triangles ? "shells of triangles around ellipsoids of a file; only their outside is seen"
                       : "ellipsoids of a file, such as 3D Gaussians; only their outside is seen");
  p.file("filename", d.filename, "the name of a PLY file of Gaussian splatting");
  if (d.triangles)
    p.choice("shell", d.shell,
             {{"default", Shell::usual},
              {"ico_sphere", Shell::ico_sphere},
              {"box", Shell::box},
              {"uv_sphere", Shell::uv_sphere}},
             "20, 20, 12 or 72 triangles");
  p.positive("scale_factor", d.scale_factor, "factor of the file's scales");
  p.positive("extent", d.extent, "semi-axes in terms of the file's scales");
  p.boolean("extent_adaptive_clamping", d.adapts_extent, "the extent times sqrt(2 ln(100 opacity)) / 3");
  describe_passive_shape(p);
}

/// A copy of a group of shapes, placed by to_world. The BSDFs are the group's; the instance's own index is unused.
struct InstanceDescription {
  static constexpr bool finite = true;
  static constexpr int surfaces = 1;
  ShapeGroupIndex group;
  friend bool operator==(const InstanceDescription&, const InstanceDescription&) = default;
};

template <class P>
void describe(P& p, InstanceDescription& d) {
  p.plugin("instance", "a copy of a shape group");
  p.shape_group(d.group, "a <ref> to a shapegroup");
  p.also("to_world", scene_xml::ParamType::transform, "", "places the copy; it has an inverse");
}

struct ShapeDescription {
  SourceLoc loc;
  std::string id;
  std::variant<SphereDescription, RectangleDescription, CubeDescription, MeshDescription, DiskDescription,
               CylinderDescription, PlaneDescription, HeightfieldDescription, CurvesDescription, SdfGridDescription,
               EllipsoidsDescription, InstanceDescription>
      geometry;
  Transform to_world;
  bool flip_normals = false;
  BsdfIndex bsdf;
  std::optional<Colour> radiance;                 ///< of an area emitter on the side the normal points to
  bool emits_by_vertex_normals = false;           ///< a mesh that emits by interpolated normals (as_mitsuba.h)
  bool emits_along_normal = false;                ///< `radiance` is the irradiance of a beam along the normal, W m^-2
  bool measures = false;                          ///< the scene's irradiancemeter is its front
  std::optional<MediumIndex> interior, exterior;  ///< behind the surface and before it
};

/// Shapes that exist only where instances place them; they do not emit.
struct ShapeGroupDescription {
  SourceLoc loc;
  std::string id;
  std::vector<ShapeDescription> shapes;
};

}  // namespace photonproof::inline scenes_description
