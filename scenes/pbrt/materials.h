// pbrt's materials as BSDFs. pbrt's reflect on both sides.
#pragma once

#include <map>
#include <set>
#include <string>

#include "scenes/pbrt/textures.h"

namespace photonproof::inline scenes_pbrt {

class PbrtMaterials {
 public:
  struct Made {
    BsdfIndex bsdf;
    bool textured = false;  ///< it needs texture coordinates
  };

  PbrtMaterials(PbrtContext& context, PbrtTextures& textures) : context_(context), textures_(textures) {}

  /// The directive MakeNamedMaterial.
  void define(const std::string& name, PbrtEntityPtr material) { named_.insert_or_assign(name, std::move(material)); }
  /// The BSDF that a shape has in this state. Throws InputError where there is none, once.
  Made made(const PbrtState& state, const PbrtParameters& shape);
  /// The same with holes.
  Made masked(Made material, const PbrtParameters& shape);

 private:
  using Model = decltype(BsdfDescription::model);
  struct Roughness {
    Scalar u, v;
    bool smooth;
  };

  Made made(const PbrtEntityPtr& material, int depth);
  Made made_new(const PbrtEntity& material, int depth);
  BsdfIndex model_of(const PbrtEntity& material);
  BsdfIndex coated_diffuse(const PbrtParameters& p);
  BsdfIndex conductor(const PbrtParameters& p, const std::string& prefix, bool two_sided);
  BsdfIndex coated_conductor(const PbrtParameters& p);
  BsdfIndex dielectric(const PbrtParameters& p);
  BsdfIndex sheet(const PbrtParameters& p);
  BsdfIndex hair(const PbrtParameters& p);
  Made mix(const PbrtParameters& p, int depth);
  BsdfIndex with_relief(BsdfIndex bsdf, const PbrtParameters& p);
  TextureIndex normal_map(const PbrtParameters& p, const PbrtParameter& file);
  Roughness roughness(const PbrtParameters& p, const std::string& prefix);
  void fail_unless_constant(const PbrtParameters& p, const Scalar& number) const;
  BsdfIndex add(Model model);
  BsdfIndex add_two_sided(Model model);

  PbrtContext& context_;
  PbrtTextures& textures_;
  std::map<std::string, PbrtEntityPtr> named_;
  std::map<PbrtEntityPtr, Made> made_;
  std::set<PbrtEntityPtr> refused_;
};

}  // namespace photonproof::inline scenes_pbrt
