#include "harness/verify/passes.h"

#include <algorithm>
#include <utility>

#include "scenes/description/emitter_kinds.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline harness_verify {
namespace {

/// Factor on albedos for direct light: light after two reflections is then a 32nd of light after one.
constexpr double kDim = 1.0 / 32;

struct Kept {
  bool emits = false;  ///< surfaces emit instead of reflecting, and lights are gone
  bool indirect = false, textures = false, gloss = false, mirrors = false, glass = false, media = false;
};

RgbD mean_of(const Image& image) {
  double sum[3] = {0, 0, 0};
  for (std::size_t i = 0; i < image.rgb.size(); ++i) sum[i % 3] += double{image.rgb[i]};
  const double pixels = static_cast<double>(std::max<std::size_t>(1, image.pixels()));
  return {sum[0] / pixels, sum[1] / pixels, sum[2] / pixels};
}

RgbD mean_of(const SceneDescription& scene, const Colour& colour) {
  if (const RgbD* constant_colour = std::get_if<RgbD>(&colour)) return *constant_colour;
  const auto& pattern = scene.textures[std::get<TextureIndex>(colour).value].pattern;
  return std::visit(Overloaded{[](const BitmapDescription& bitmap) { return mean_of(*bitmap.image); },
                               [&](const CheckerboardDescription& board) {
                                 return (mean_of(scene, board.color0) + mean_of(scene, board.color1)) * 0.5;
                               },
                               // Every mesh has other values, from 0 to 1.
                               [](const MeshAttributeDescription&) { return RgbD(0.5); },
                               [](const VolumeTextureDescription& volume) {
                                 const RgbD* everywhere = constant_of(volume.volume);
                                 return everywhere != nullptr ? *everywhere : most(volume.volume) * 0.5;
                               },
                               [&](const ScaledTextureDescription& scaled) {
                                 return mean_of(scene, Colour(scaled.texture)) * scaled.scale;
                               }},
                    pattern);
}

class PassMaker {
 public:
  PassMaker(const SceneDescription& scene, const Kept& kept) : scene_(scene), out_(scene), kept_(kept) {}

  SceneDescription made() {
    for (BsdfDescription& bsdf : out_.bsdfs) bsdf.model = changed(bsdf);
    for (ShapeDescription& shape : out_.shapes) change(shape);
    for (ShapeGroupDescription& group : out_.groups)
      for (ShapeDescription& shape : group.shapes) change(shape);
    if (!kept_.media) {
      out_.sensor.medium.reset();
      out_.media.clear();
    }
    if (kept_.emits) std::erase_if(out_.emitters, [](const auto& emitter) { return !surrounds(emitter); });
    return std::move(out_);
  }

 private:
  using Model = decltype(BsdfDescription::model);

  /// Textures keep their values, since a scene file cannot scale those of an image file.
  Colour albedo(const Colour& colour) const {
    if (kept_.emits) return RgbD(0.0);
    if (kept_.textures && std::holds_alternative<TextureIndex>(colour)) return colour;
    return mean_of(scene_, colour) * (kept_.indirect ? 1 : kDim);
  }
  Colour factor(const Colour& colour) const { return kept_.textures ? colour : Colour(mean_of(scene_, colour)); }
  Model black() const { return DiffuseDescription{RgbD(0.0)}; }
  Model diffuse(const Colour& colour) const { return DiffuseDescription{albedo(colour)}; }
  const Model& nested(BsdfIndex index) const { return out_.bsdfs[index.value].model; }  // changed before

  template <class Coated>
  Model coated(Coated coat) const {
    if (!kept_.gloss) return diffuse(coat.diffuse_reflectance);
    coat.diffuse_reflectance = albedo(coat.diffuse_reflectance);
    coat.specular_reflectance = factor(coat.specular_reflectance);
    return coat;
  }
  template <class Metal>
  Model metal(Metal mirror) const {
    if (!kept_.mirrors) return black();
    mirror.specular_reflectance = factor(mirror.specular_reflectance);
    return mirror;
  }
  template <class Glass>
  Model body(Glass glass) const {
    if (!kept_.glass) return black();
    glass.specular_reflectance = factor(glass.specular_reflectance);
    glass.specular_transmittance = factor(glass.specular_transmittance);
    return glass;
  }

  Model burley(PrincipledDescription d) const {
    if (!kept_.gloss) return diffuse(d.base_color);
    if (!kept_.mirrors) d.metallic = 0.0;
    if (!kept_.glass) d.spec_trans = 0.0;
    d.base_color = albedo(d.base_color);
    return d;
  }
  Model burley(PrincipledThinDescription d) const {
    if (!kept_.gloss) return diffuse(d.base_color);
    if (!kept_.glass) d.spec_trans = d.diff_trans = 0.0;
    d.base_color = albedo(d.base_color);
    return d;
  }

  Model changed(const BsdfDescription& bsdf) const {
    return std::visit(
        Overloaded{[&](const DiffuseDescription& d) { return diffuse(d.reflectance); },
                   [&](const PlasticDescription& d) { return coated(d); },
                   [&](const RoughPlasticDescription& d) { return coated(d); },
                   [&](const PhongDescription& d) { return coated(d); },
                   [&](const PrincipledDescription& d) { return burley(d); },
                   [&](const PrincipledThinDescription& d) { return burley(d); },
                   [&](const LayeredDescription& d) { return kept_.gloss ? Model(d) : nested(d.base); },
                   [&](const ConductorDescription& d) { return metal(d); },
                   [&](const RoughConductorDescription& d) { return metal(d); },
                   [&](const DielectricDescription& d) { return body(d); },
                   [&](const ThinDielectricDescription& d) { return body(d); },
                   [&](const RoughDielectricDescription& d) { return body(d); },
                   [&](const BumpMapDescription& d) { return kept_.textures ? Model(d) : nested(d.nested); },
                   [&](const NormalMapDescription& d) { return kept_.textures ? Model(d) : nested(d.nested); },
                   [](const NullDescription& d) { return Model(d); },
                   [&](DiffuseTransmitterDescription d) {
                     d.transmittance = albedo(d.transmittance);
                     return Model(d);
                   },
                   [](const WrappingBsdf auto& d) { return Model(d); }},
        bsdf.model);
  }

  /// Whether, in the original scene, the surface itself is visible rather than what it mirrors or lets through.
  bool is_scenery(BsdfIndex index) const {
    if (traits_of(scene_.bsdfs[index.value]).shows_others) return false;
    return std::ranges::all_of(nested_bsdfs(scene_.bsdfs[index.value]),
                               [&](BsdfIndex inner) { return is_scenery(inner); });
  }

  void change(ShapeDescription& shape) {
    if (!kept_.media) {
      shape.interior.reset();
      shape.exterior.reset();
    }
    if (!kept_.emits || std::holds_alternative<InstanceDescription>(shape.geometry)) return;
    // Several brightnesses, so that shifts become visible.
    constexpr double of_next[] = {0.25, 4.0, 1.0, 2.0, 0.5};
    const double radiance = of_next[count_++ % std::size(of_next)];
    shape.radiance.reset();
    if (is_scenery(shape.bsdf)) shape.radiance = RgbD(radiance);
  }

  const SceneDescription& scene_;
  SceneDescription out_;
  Kept kept_;
  std::size_t count_ = 0;
};

struct Holds {
  bool diffuse = false, gloss = false, mirrors = false, glass = false, textures = false, media = false, groups = false;
};

Holds what_is_in(const SceneDescription& scene) {
  Holds holds;
  for (const BsdfDescription& bsdf : scene.bsdfs)
    std::visit(Overloaded{[&](const DiffuseDescription& d) { holds.diffuse |= mean_of(scene, d.reflectance).x > 0; },
                          [&](const PlasticDescription&) { holds.gloss = true; },
                          [&](const RoughPlasticDescription&) { holds.gloss = true; },
                          [&](const PhongDescription&) { holds.gloss = true; },
                          [&](const PrincipledDescription& d) {
                            holds.diffuse = holds.gloss = true;
                            holds.mirrors |= d.metallic != Scalar(0.0);
                            holds.glass |= d.transmits();
                          },
                          [&](const PrincipledThinDescription&) { holds.diffuse = holds.gloss = holds.glass = true; },
                          [&](const LayeredDescription&) { holds.gloss = true; },
                          [&](const ConductorDescription&) { holds.mirrors = true; },
                          [&](const RoughConductorDescription&) { holds.mirrors = true; },
                          [&](const DielectricDescription&) { holds.glass = true; },
                          [&](const ThinDielectricDescription&) { holds.glass = true; },
                          [&](const RoughDielectricDescription&) { holds.glass = true; }, [](const NullDescription&) {},
                          [&](const DiffuseTransmitterDescription&) { holds.diffuse = true; },
                          [](const WrappingBsdf auto&) {}},
               bsdf.model);
  holds.textures = !scene.textures.empty();
  holds.media = !scene.media.empty();
  holds.groups = !scene.groups.empty();
  return holds;
}

}  // namespace

std::vector<ScenePass> passes_of(const SceneDescription& scene) {
  const Holds holds = what_is_in(scene);
  std::vector<ScenePass> passes;
  const auto add = [&](bool has, const char* name, const char* words, const Kept& kept) {
    if (has) passes.push_back({name, words, PassMaker(scene, kept).made()});
  };
  const bool reflects = holds.diffuse || holds.gloss;
  // Shapes of groups cannot emit (docs/formats/scene.md).
  add(!holds.groups, "shapes", "camera, shapes and their sides", {.emits = true});
  add(reflects, "direct", "light from lights on diffuse surfaces", {});
  add(reflects, "indirect", "light between diffuse surfaces", {.indirect = true});
  add(holds.textures, "texture", "textures and maps", {.textures = true});
  add(holds.gloss, "gloss", "plastic, lacquer and Phong", {.gloss = true});
  add(holds.mirrors && !holds.groups, "mirror", "light seen in mirrors", {.emits = true, .mirrors = true});
  add(holds.glass && !holds.groups, "glass", "light seen through glass", {.emits = true, .glass = true});
  add((holds.mirrors || holds.glass) && reflects, "caustic", "light by mirrors and through glass",
      {.indirect = true, .gloss = true, .mirrors = true, .glass = true});
  add(holds.media, "medium", "absorption and scattering",
      {.indirect = true, .gloss = true, .mirrors = true, .glass = true, .media = true});
  return passes;
}

}  // namespace photonproof::inline harness_verify
