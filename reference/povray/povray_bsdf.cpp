#include "reference/povray/povray_bsdf.h"

#include <algorithm>
#include <stdexcept>

#include "reference/povray/unrepresentable.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_povray {
namespace {

ColourRange range_of(const SceneDescription& scene, const BitmapDescription& bitmap, const SourceLoc& loc) {
  if (bitmap.wrap == TextureWrap::clamp)
    throw Unrepresentable(scene.where(loc), "a bitmap with wrap_mode clamp: POV-Ray's image maps repeat or end");
  if (!bitmap.to_uv.inverse()) throw Unrepresentable(scene.where(loc), "a texture whose to_uv has no inverse");
  ColourRange range;
  const Image& image = *bitmap.image;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const RgbD c(double{image.rgb[i]}, double{image.rgb[i + 1]}, double{image.rgb[i + 2]});
    range.mean += c;
    range.greatest = std::max(range.greatest, max_component(c));
  }
  range.mean = range.mean * (1.0 / static_cast<double>(image.pixels()));
  return range;
}

ColourRange range_of(const SceneDescription& scene, const CheckerboardDescription& board, const SourceLoc& loc) {
  if (!std::holds_alternative<RgbD>(board.color0) || !std::holds_alternative<RgbD>(board.color1))
    throw Unrepresentable(scene.where(loc), "a checkerboard of textures; one of constant colours can be written");
  if (!board.to_uv.inverse()) throw Unrepresentable(scene.where(loc), "a texture whose to_uv has no inverse");
  const RgbD &a = constant(board.color0), &b = constant(board.color1);
  return {(a + b) * 0.5, std::max(max_component(a), max_component(b))};
}

ColourRange range_of(const SceneDescription& scene, const MeshAttributeDescription&, const SourceLoc& loc) {
  throw Unrepresentable(scene.where(loc), "an attribute of a mesh: not written yet");
}

ColourRange range_of(const SceneDescription& scene, const VolumeTextureDescription&, const SourceLoc& loc) {
  throw Unrepresentable(scene.where(loc), "a volume as a texture: not written yet");
}

ColourRange range_of(const SceneDescription& scene, const ScaledTextureDescription&, const SourceLoc& loc) {
  throw Unrepresentable(scene.where(loc), "a scaled texture: not written yet");
}

[[noreturn]] void refuse(const SceneDescription& scene, const BsdfDescription& bsdf, const std::string& why) {
  throw Unrepresentable(scene.where(bsdf.loc), why);
}

void require_constant(const SceneDescription& scene, const BsdfDescription& bsdf, const Colour& colour) {
  if (!std::holds_alternative<RgbD>(colour))
    refuse(scene, bsdf, "a texture of something else than diffuse reflectance or radiance");
}

constexpr const char* kGlossy =
    "POV-Ray's glossy highlights answer light_sources only and are no microfacets, and its mirrors are smooth";

// The reason why a leaf cannot be written, by model; empty for leaves that can.
struct Check {
  const SceneDescription& scene;
  const BsdfDescription& bsdf;

  void operator()(const DiffuseDescription& d) const { photonproof::range_of(scene, d.reflectance); }
  void operator()(const ConductorDescription& d) const { require_constant(scene, bsdf, d.specular_reflectance); }
  void operator()(const DielectricDescription& d) const {
    require_constant(scene, bsdf, d.specular_reflectance);
    require_constant(scene, bsdf, d.specular_transmittance);
    if (d.priority) refuse(scene, bsdf, "the priority of a dielectric: POV-Ray has none");
  }
  void operator()(const ThinDielectricDescription& d) const {
    require_constant(scene, bsdf, d.specular_reflectance);
    require_constant(scene, bsdf, d.specular_transmittance);
  }
  void operator()(const RoughConductorDescription&) const {
    refuse(scene, bsdf, std::string("a rough conductor: ") + kGlossy);
  }
  void operator()(const RoughDielectricDescription&) const {
    refuse(scene, bsdf, std::string("a rough dielectric: ") + kGlossy);
  }
  void operator()(const RoughPlasticDescription&) const {
    refuse(scene, bsdf, std::string("a rough plastic: ") + kGlossy);
  }
  void operator()(const PhongDescription&) const {
    refuse(scene, bsdf,
           "phong: POV-Ray's is without the cosine of the light's incidence and answers light_sources only");
  }
  void operator()(const PrincipledDescription&) const {
    refuse(scene, bsdf, std::string("a principled BSDF: ") + kGlossy);
  }
  void operator()(const PrincipledThinDescription&) const {
    refuse(scene, bsdf, std::string("a thin principled BSDF: ") + kGlossy);
  }
  void operator()(const PlasticDescription& d) const {
    require_constant(scene, bsdf, d.diffuse_reflectance);
    require_constant(scene, bsdf, d.specular_reflectance);
    require_denser(d);
  }
  void operator()(const LayeredDescription& d) const {
    require_constant(scene, bsdf, d.specular_reflectance);
    require_denser(d);
    const auto* base = std::get_if<DiffuseDescription>(&scene.bsdfs[d.base.value].model);
    if (!base) refuse(scene, bsdf, "a lacquer over something else than a diffuse base");
    require_constant(scene, bsdf, base->reflectance);
  }
  template <class Coated>
  void require_denser(const Coated& d) const {
    if (d.int_ior < d.ext_ior) refuse(scene, bsdf, "a coat of a lower index than what is above it");
  }
  void operator()(const BumpMapDescription&) const {
    refuse(scene, bsdf, "a bump map: POV-Ray perturbs normals by another rule");
  }
  void operator()(const NormalMapDescription&) const { refuse(scene, bsdf, "a normal map: POV-Ray has none"); }
  void operator()(const DiffuseTransmitterDescription&) const {
    refuse(scene, bsdf, "a diffuse transmitter: POV-Ray has none");
  }
  void operator()(const NullDescription&) const { refuse(scene, bsdf, "'null' inside another bsdf"); }
  void operator()(const MaskDescription&) const { refuse(scene, bsdf, "a mask inside another bsdf"); }
  void operator()(const TwoSidedDescription&) const { refuse(scene, bsdf, "'twosided' inside a blend"); }
  void operator()(const BlendDescription& d) const {
    if (!std::holds_alternative<double>(d.weight)) refuse(scene, bsdf, "a blend whose weight is a texture");
    for (const BsdfIndex part : {d.first, d.second}) {
      const BsdfDescription& of = scene.bsdfs[part.value];
      if (std::holds_alternative<DielectricDescription>(of.model) ||
          std::holds_alternative<ThinDielectricDescription>(of.model))
        refuse(scene, bsdf, "a blend with something that transmits");
      std::visit(Check{scene, of}, of.model);
    }
  }
};

const BsdfDescription* checked(const SceneDescription& scene, BsdfIndex index) {
  const BsdfDescription& side = scene.bsdfs[index.value];
  std::visit(Check{scene, side}, side.model);
  return &side;
}

}  // namespace

ColourRange range_of(const SceneDescription& scene, const Colour& colour) {
  if (const auto* rgb = std::get_if<RgbD>(&colour)) return {*rgb, max_component(*rgb)};
  const TextureDescription& texture = scene.textures[std::get<TextureIndex>(colour).value];
  return std::visit([&](const auto& pattern) { return range_of(scene, pattern, texture.loc); }, texture.pattern);
}

PovSides resolve_bsdf(const SceneDescription& scene, BsdfIndex index) {
  const BsdfDescription& bsdf = scene.bsdfs[index.value];
  if (std::holds_alternative<NullDescription>(bsdf.model)) {
    PovSides sides;
    sides.nothing = true;
    return sides;
  }
  if (const auto* mask = std::get_if<MaskDescription>(&bsdf.model)) {
    if (!std::holds_alternative<double>(mask->opacity))
      refuse(scene, bsdf, "a mask whose opacity is a texture; a number can be written");
    PovSides sides = resolve_bsdf(scene, mask->nested);
    sides.opacity *= std::get<double>(mask->opacity);
    if (!sides.nothing && optics_of(scene, *sides.front).refracts) refuse(scene, bsdf, "a mask over a dielectric");
    return sides;
  }
  PovSides sides;
  if (const auto* both = std::get_if<TwoSidedDescription>(&bsdf.model)) {
    sides.front = checked(scene, both->front);
    sides.back = checked(scene, both->back);
    return sides;
  }
  sides.front = checked(scene, index);
  return sides;
}

PovOptics optics_of(const SceneDescription& scene, const BsdfDescription& side) {
  return std::visit(Overloaded{[&](const DiffuseDescription& d) {
                                 return PovOptics{range_of(scene, d.reflectance), false, false};
                               },
                               [&](const BlendDescription& blend) {
                                 const double w = std::get<double>(blend.weight);
                                 const PovOptics a = optics_of(scene, scene.bsdfs[blend.first.value]);
                                 const PovOptics b = optics_of(scene, scene.bsdfs[blend.second.value]);
                                 return PovOptics{{a.diffuse.mean * (1 - w) + b.diffuse.mean * w,
                                                   a.diffuse.greatest * (1 - w) + b.diffuse.greatest * w},
                                                  a.specular || b.specular,
                                                  false};
                               },
                               [](const DielectricDescription&) {
                                 return PovOptics{{}, true, true};
                               },
                               [&](const auto&) {
                                 PovOptics optics{{}, true, false};
                                 if (const auto coat = coat_on(scene, side)) {
                                   optics.diffuse.mean = coat->diffuse_albedo();
                                   optics.diffuse.greatest = max_component(optics.diffuse.mean);
                                 }
                                 return optics;
                               }},
                    side.model);
}

std::optional<Coat> coat_on(const SceneDescription& scene, const BsdfDescription& side) {
  if (const auto* plastic = std::get_if<PlasticDescription>(&side.model))
    return coat_of(*plastic, constant(plastic->diffuse_reflectance), constant(plastic->specular_reflectance));
  if (const auto* lacquer = std::get_if<LayeredDescription>(&side.model)) {
    const auto& base = std::get<DiffuseDescription>(scene.bsdfs[lacquer->base.value].model);
    return coat_of(*lacquer, constant(base.reflectance), constant(lacquer->specular_reflectance));
  }
  return std::nullopt;
}

bool is_textured(const SceneDescription& scene, const BsdfDescription& side) {
  if (const auto* blend = std::get_if<BlendDescription>(&side.model))
    return is_textured(scene, scene.bsdfs[blend->first.value]) || is_textured(scene, scene.bsdfs[blend->second.value]);
  const auto* diffuse = std::get_if<DiffuseDescription>(&side.model);
  return diffuse && std::holds_alternative<TextureIndex>(diffuse->reflectance);
}

}  // namespace photonproof::inline reference_povray
