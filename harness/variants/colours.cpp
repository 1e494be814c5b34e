#include "harness/variants/colours.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "scenes/description/param_type.h"

namespace photonproof::inline harness_variants {
namespace {

/// Called by `describe` (scenes/description/description.h): changes the colours and leaves the rest.
struct PluginColours {
  const ColourChange& change;
  bool emissions_only = false;

  void set(RgbD& v) { v = change(v); }
  void set(Colour& v) {
    if (auto* colour = std::get_if<RgbD>(&v)) set(*colour);
  }
  void colour(const char*, RgbD& v, const scene_xml::Range&, const char*) {
    if (!emissions_only) set(v);
  }
  void emission(const char*, RgbD& v, const char*) { set(v); }
  void emission_map(const char*, Colour& v, const char*) { set(v); }
  void colour_map(const char*, Colour& v, const scene_xml::Range&, const char*) {
    if (!emissions_only) set(v);
  }
  void volume(const char*, VolumeColour& v, const scene_xml::Range&, const char*) {
    if (RgbD* colour = constant_of(v); colour != nullptr && !emissions_only) set(*colour);
  }
  void volume_number(const char*, const VolumeNumber&, const scene_xml::Range&, const char*) {}
  void metal(std::optional<ComplexIor>& ior) {
    if (!ior || emissions_only) return;
    set(ior->eta);
    set(ior->k);
  }

  void plugin(const char*, const char*) {}
  void boolean(const char*, bool, const char*) {}
  void integer(const char*, std::int64_t, std::int64_t, std::int64_t, const char*) {}
  void optional_integer(const char*, const std::optional<int>&, std::int64_t, std::int64_t, const char*) {}
  void number(const char*, double, const scene_xml::Range&, const char*) {}
  void optional_number(const char*, const std::optional<double>&, const scene_xml::Range&, const char*) {}
  void number_after(const char*, double, double, const char*, const char*) {}
  void positive(const char*, double, const char*, double = 0, const char* = "") {}
  void ior(const char*, double, const char*) {}
  void number_map(const char*, const Scalar&, const scene_xml::Range&, const char*) {}
  void texture(const char*, TextureIndex, const char*) {}
  void optional_texture(const char*, const std::optional<TextureIndex>&, const char*) {}
  void nested_texture(TextureIndex, const char*) {}
  template <class Value>
  void choice(const char*, Value, std::initializer_list<scene_xml::Word<std::type_identity_t<Value>>>, const char*) {}
  void file(const char*, const std::string&, const char*) {}
  void text(const char*, const std::string&, const char*) {}
  void point(const char*, const Vec3d&, const char*) {}
  void direction(const char*, const Vec3d&, const char*) {}
  void transform(const char*, const Transform&, const char*) {}
  void roughness(const Scalar&, const Scalar&) {}
  void eta_or_specular(const std::optional<double>&, double) {}
  void sun(const Vec3d&, const Transform&, const char*) {}
  void bsdf(BsdfIndex, const char*) {}
  void two_bsdfs(BsdfIndex, BsdfIndex, const char*) {}
  void one_or_two_bsdfs(BsdfIndex, BsdfIndex, const char*) {}
  template <class Describe>
  void field_of_view(double, FovAxis, Describe&&) {}
  void require(const char*, const char*) {}
  void nested(const char*, std::size_t, const char*) {}
  template <class... Rest>
  void also(const char*, scene_xml::ParamType, const Rest&...) {}
};

[[noreturn]] void in_a_file(const SceneDescription& scene, const SourceLoc& loc, const char* what) {
  throw InputError(scene.where(loc), std::string(what) + ", and a variant changes numbers alone");
}

void change_lights(SceneDescription& scene, PluginColours& colours) {
  for (ShapeDescription& shape : scene.shapes) {
    if (!shape.radiance) continue;
    if (std::holds_alternative<TextureIndex>(*shape.radiance) && colours.emissions_only)
      in_a_file(scene, shape.loc, "the light's radiance is a texture");
    colours.set(*shape.radiance);
  }
  for (EmitterDescription& emitter : scene.emitters)
    std::visit([&](auto& light) { describe(colours, light); }, emitter.light);
}

}  // namespace

void change_all_colours(SceneDescription& scene, const ColourChange& change) {
  PluginColours colours{change};
  for (TextureDescription& texture : scene.textures) {
    if (std::holds_alternative<BitmapDescription>(texture.pattern))
      in_a_file(scene, texture.loc, "the colours of a bitmap stand in its file");
    if (std::holds_alternative<MeshAttributeDescription>(texture.pattern))
      in_a_file(scene, texture.loc, "the colours of a mesh stand in its file");
    if (const auto* volume = std::get_if<VolumeTextureDescription>(&texture.pattern))
      if (constant_of(volume->volume) == nullptr)
        in_a_file(scene, texture.loc, "the colours of a volume stand in its file");
    std::visit([&](auto& pattern) { describe(colours, pattern); }, texture.pattern);
  }
  for (BsdfDescription& bsdf : scene.bsdfs) std::visit([&](auto& model) { describe(colours, model); }, bsdf.model);
  for (MediumDescription& medium : scene.media) {
    if (!volumes_of(medium).empty()) in_a_file(scene, medium.loc, "the colours of a volume stand in its file");
    std::visit([&](auto& model) { describe(colours, model); }, medium.model);
  }
  for (const EmitterDescription& emitter : scene.emitters)
    if (std::holds_alternative<EnvmapDescription>(emitter.light) ||
        std::holds_alternative<SunSkyDescription>(emitter.light))
      in_a_file(scene, emitter.loc, "the sky's colours are its own");
  change_lights(scene, colours);
}

void scale_lights(SceneDescription& scene, double factor) {
  const ColourChange change = [factor](const RgbD& c) { return c * factor; };
  PluginColours colours{change, true};
  change_lights(scene, colours);
  for (EmitterDescription& emitter : scene.emitters) {
    if (auto* map = std::get_if<EnvmapDescription>(&emitter.light)) map->scale *= factor;
    if (auto* sky = std::get_if<SunSkyDescription>(&emitter.light)) {
      sky->sun_scale *= factor;
      sky->sky_scale *= factor;
    }
    if (auto* projector = std::get_if<ProjectorDescription>(&emitter.light))
      if (std::holds_alternative<TextureIndex>(projector->irradiance)) projector->scale *= factor;
  }
}

}  // namespace photonproof::inline harness_variants
