// pbrt's shapes, with their materials, holes, lights and media.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "scenes/pbrt/curves.h"
#include "scenes/pbrt/materials.h"
#include "scenes/pbrt/quadrics.h"

namespace photonproof::inline scenes_pbrt {

class PbrtShapes {
 public:
  PbrtShapes(PbrtContext& context, PbrtTextures& textures, PbrtMaterials& materials)
      : context_(context), textures_(textures), materials_(materials), curves_(context) {}

  /// The directive Shape, into the group of this number or, if it is negative, into the scene. Throws InputError.
  void add(const std::string& type, const PbrtParameters& parameters, const PbrtState& state, int group);
  /// Adds shapes that are made of many directives.
  void finish() { curves_.finish(); }

 private:
  struct Mesh {
    std::string file;
    bool has_normals = false;
    bool is_flat = false;                     ///< all triangles lie in one plane
    Vec3d normal{0, 0, 0};                    ///< of that plane
    double size = 0;                          ///< greatest distance from the first vertex
    std::vector<std::array<Vec3d, 2>> edges;  ///< of the first triangles, two each
  };
  struct Placed {
    ShapeDescription shape;
    double area = 0;             ///< of a quadric, before its transform, as in pbrt
    const Mesh* mesh = nullptr;  ///< null where the shape is no mesh
  };

  const Mesh& file_mesh(const PbrtParameters& p, bool textured);
  PbrtQuadric quadric(const std::string& type, const PbrtParameters& p) const;
  bool place_whole(const PbrtQuadric& quadric, Placed& placed) const;
  const Mesh& quadric_mesh(const PbrtQuadric& quadric);
  Mesh written(TriangleMesh mesh, bool textured);
  static void use(const Mesh& mesh, Placed& placed);
  void add_curve(const PbrtParameters& p, const PbrtState& state, const Transform& to_world, BsdfIndex bsdf, int group);
  void place(const std::string& type, const PbrtParameters& p, bool textured, bool in_group, Placed& placed);
  void add_light(const PbrtEntity& light, Placed& placed);
  static double emitting_area(const PbrtEntity& light, const Placed& placed);
  std::optional<MediumIndex> medium(const std::string& name, const PbrtParameters& p) const;

  PbrtContext& context_;
  PbrtTextures& textures_;
  PbrtMaterials& materials_;
  PbrtCurves curves_;
  std::map<std::pair<std::string, bool>, Mesh> files_;
  std::map<PbrtQuadric, Mesh> quadrics_;
};

}  // namespace photonproof::inline scenes_pbrt
