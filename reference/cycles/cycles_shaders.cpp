#include "reference/cycles/cycles_shaders.h"

#include <type_traits>

#include "reference/cycles/python_text.h"
#include "scenes/base/text_numbers.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_cycles {
namespace {

/// The two rows of to_uv that count, each the factors of u and v and the offset.
std::string rows_py(const Transform& t) {
  const auto row = [&](std::size_t i) { return py_tuple(Vec3d{t.m[i], t.m[i + 1], t.m[i + 3]}); };
  return "(" + row(0) + ", " + row(4) + ")";
}

std::string scalar_py(CyclesScript& script, const Scalar& scalar) {
  if (const auto* number = std::get_if<double>(&scalar)) return format_number(*number);
  return "g.luminance(" + colour_py(script, std::get<TextureIndex>(scalar)) + ")";
}

/// Distribution and alpha.
template <class Rough>
std::string facets_py(const CyclesScript& script, const BsdfDescription& bsdf, const std::string& what,
                      const Rough& d) {
  const auto *u = std::get_if<double>(&d.alpha_u), *v = std::get_if<double>(&d.alpha_v);
  if (!u || !v) script.refuse(bsdf.loc, what + " whose alpha is a texture; a number can be written");
  if (*u != *v) script.refuse(bsdf.loc, what + " that is rougher along one tangent than along the other");
  return std::string(d.distribution == MicrofacetDistribution::ggx ? "\"GGX\"" : "\"BECKMANN\"") + ", " +
         format_number(*u);
}

/// Reflection of one side of a surface. Throws NotRepresentable for models that Cycles has no equivalent of.
struct Side {
  CyclesScript& script;
  const BsdfDescription& bsdf;

  [[noreturn]] void refuse(const std::string& why) const { script.refuse(bsdf.loc, why); }

  std::string operator()(const DiffuseDescription& d) const {
    return "g.diffuse(" + colour_py(script, d.reflectance) + ")";
  }
  std::string operator()(const ConductorDescription& d) const {
    const std::string colour = colour_py(script, d.specular_reflectance);
    if (!d.ior) return "g.mirror(" + colour + ")";
    return "g.conductor(" + py_tuple(d.ior->eta) + ", " + py_tuple(d.ior->k) + ", " + colour + ")";
  }
  std::string operator()(const RoughConductorDescription& d) const {
    const std::string facets = facets_py(script, bsdf, "a rough conductor", d);
    const std::string colour = colour_py(script, d.specular_reflectance);
    if (!d.ior) return "g.metal(" + colour + ", " + facets + ")";
    return "g.rough_conductor(" + py_tuple(d.ior->eta) + ", " + py_tuple(d.ior->k) + ", " + colour + ", " + facets +
           ")";
  }
  std::string operator()(const BlendDescription& d) const {
    const auto part = [&](BsdfIndex index) {
      const BsdfDescription& nested = script.scene().bsdfs[index.value];
      return std::visit(Side{script, nested}, nested.model);
    };
    return "g.mix(" + part(d.first) + ", " + part(d.second) + ", " + scalar_py(script, d.weight) + ")";
  }
  std::string operator()(const PlasticDescription& d) const {
    return "g.plastic(" + format_number(d.int_ior / d.ext_ior) + ", " + colour_py(script, d.diffuse_reflectance) +
           ", " + colour_py(script, d.specular_reflectance) + (d.nonlinear ? ", True)" : ", False)");
  }
  std::string operator()(const RoughPlasticDescription&) const { refuse(std::string("a rough plastic: ") + coat); }
  std::string operator()(const LayeredDescription&) const { refuse(std::string("a lacquer: ") + coat); }
  std::string operator()(const PhongDescription& d) const {
    const auto* exponent = std::get_if<double>(&d.exponent);
    if (!exponent) refuse("phong whose exponent is a texture; a number can be written");
    return "g.phong(" + format_number(*exponent) + ", " + colour_py(script, d.diffuse_reflectance) + ", " +
           colour_py(script, d.specular_reflectance) + ")";
  }
  std::string operator()(const PrincipledDescription&) const { refuse(std::string("a principled BSDF: ") + burley); }
  std::string operator()(const PrincipledThinDescription&) const {
    refuse(std::string("a thin principled BSDF: ") + burley);
  }
  std::string operator()(const DiffuseTransmitterDescription&) const {
    refuse("a diffuse transmitter: not written yet");
  }
  std::string operator()(const BumpMapDescription&) const {
    refuse("a bump map: Cycles perturbs normals by another rule");
  }
  std::string operator()(const NormalMapDescription&) const {
    refuse("a normal map: Cycles bends mapped normals by a rule of its own where they look away");
  }
  template <class Other>
  std::string operator()(const Other&) const {
    refuse("something that transmits, in the place of one side of a surface");
  }

  static constexpr const char* burley = "Cycles' principled shader has other lobes than Burley's of 2012 and 2015";
  static constexpr const char* coat =
      "light enters its coat by the light's direction, and the colour of Cycles' diffuse reflection depends on the "
      "viewer's alone";
};

/// A surface as it is met from both sides.
struct Surface {
  CyclesScript& script;
  const BsdfDescription& bsdf;
  bool leaning = false;

  std::string of(BsdfIndex index) const {
    const BsdfDescription& nested = script.scene().bsdfs[index.value];
    return std::visit(Surface{script, nested, leaning}, nested.model);
  }
  std::string side(BsdfIndex index) const {
    const BsdfDescription& nested = script.scene().bsdfs[index.value];
    return std::visit(Side{script, nested}, nested.model);
  }

  std::string operator()(const TwoSidedDescription& d) const {
    const std::string front = side(d.front);
    return d.front == d.back ? front : "g.sides(" + front + ", " + side(d.back) + ")";
  }
  std::string operator()(const MaskDescription& d) const {
    return "g.mix(g.clear(), " + of(d.nested) + ", " + scalar_py(script, d.opacity) + ")";
  }
  std::string operator()(const BlendDescription& d) const {
    return "g.mix(" + of(d.first) + ", " + of(d.second) + ", " + scalar_py(script, d.weight) + ")";
  }
  std::string operator()(const NullDescription&) const { return "g.clear()"; }
  std::string operator()(const DielectricDescription& d) const {
    if (d.priority) script.refuse(bsdf.loc, "a dielectric with a priority: Cycles has no nested bodies");
    return "g.glass(" + optics(d) + ")";
  }
  std::string operator()(const RoughDielectricDescription& d) const {
    return "g.rough_glass(" + optics(d) + ", " + facets_py(script, bsdf, "a rough dielectric", d) + ")";
  }
  std::string operator()(const ThinDielectricDescription& d) const { return "g.pane(" + optics(d) + ")"; }
  template <class Opaque>
  std::string operator()(const Opaque& d) const {
    const std::string text = "g.sides(" + Side{script, bsdf}(d) + ", None)";  // black from behind
    return leaning ? "g.seen(" + text + ")" : text;
  }

 private:
  template <class Interface>
  std::string optics(const Interface& d) const {
    return format_number(d.int_ior / d.ext_ior) + ", " + colour_py(script, d.specular_reflectance) + ", " +
           colour_py(script, d.specular_transmittance);
  }
};

std::string bitmap_py(CyclesScript& script, const BitmapDescription& bitmap, const SourceLoc& loc) {
  if (bitmap.wrap == TextureWrap::mirror)
    script.refuse(loc, "a texture that is mirrored beyond its edges; repeated and clamped ones can be written");
  return "g.image(" + py_string(script.file_of(bitmap.image)) + ", " + rows_py(bitmap.to_uv) + ", " +
         (bitmap.wrap == TextureWrap::repeat ? "\"REPEAT\"" : "\"EXTEND\"") + ", " +
         (bitmap.filter == TextureFilter::bilinear ? "\"Linear\"" : "\"Closest\"") + ")";
}

}  // namespace

std::string colour_py(CyclesScript& script, const Colour& colour) {
  if (const auto* rgb = std::get_if<RgbD>(&colour)) return py_tuple(*rgb);
  const TextureDescription& texture = script.scene().textures[std::get<TextureIndex>(colour).value];
  return std::visit(Overloaded{[&](const BitmapDescription& bitmap) { return bitmap_py(script, bitmap, texture.loc); },
                               [&](const CheckerboardDescription& board) {
                                 return "g.checkerboard(" + colour_py(script, board.color0) + ", " +
                                        colour_py(script, board.color1) + ", " + rows_py(board.to_uv) + ")";
                               },
                               [&](const MeshAttributeDescription&) -> std::string {
                                 script.refuse(texture.loc, "an attribute of a mesh: not written yet");
                               },
                               [&](const VolumeTextureDescription&) -> std::string {
                                 script.refuse(texture.loc, "a volume as a texture: not written yet");
                               },
                               [&](const ScaledTextureDescription&) -> std::string {
                                 script.refuse(texture.loc, "a scaled texture: not written yet");
                               }},
                    texture.pattern);
}

std::string medium_py(const CyclesScript& script, MediumIndex index) {
  const MediumDescription& described = script.scene().media[index.value];
  if (described.varies())
    script.refuse(described.loc, "a medium that varies: the export writes homogeneous media alone");
  const auto& medium = std::get<HomogeneousDescription>(described.model);
  const RgbD* albedo = constant_of(medium.albedo);
  if (albedo == nullptr)
    script.refuse(described.loc, "an albedo that varies: the export writes homogeneous media alone");
  const RgbD extinction = medium.sigma_t * medium.scale, scattering = extinction * *albedo;
  const auto* lobe = std::get_if<HenyeyGreensteinDescription>(&medium.phase);
  if (lobe == nullptr && !std::holds_alternative<IsotropicDescription>(medium.phase))
    script.refuse(described.loc, "a phase function other than isotropic and hg: the export writes those two alone");
  return "lambda g: g.medium(" + py_tuple(scattering) + ", " + py_tuple(extinction - scattering) + ", " +
         format_number(lobe ? lobe->g : 0) + ")";
}

std::string material_py(CyclesScript& script, const std::string& name, const CyclesMaterial& material) {
  const BsdfDescription& bsdf = script.scene().bsdfs[material.bsdf.value];
  std::string surface = std::visit(Surface{script, bsdf, material.leaning}, bsdf.model);
  if (material.radiance)
    surface = "g.sum(g.sides(g.glow(" + colour_py(script, *material.radiance) + "), None), " + surface + ")";
  std::string text = "material(" + py_string(name) + ", lambda g: " + surface;
  if (material.interior) text += ", " + medium_py(script, *material.interior);
  return text + (material.sampled ? ")" : ", sampled=False)");
}

bool is_nothing(const SceneDescription& scene, BsdfIndex index) {
  return std::holds_alternative<NullDescription>(scene.bsdfs[index.value].model);
}

CyclesTraits traits_of(const SceneDescription& scene, BsdfIndex index) {
  const BsdfDescription& bsdf = scene.bsdfs[index.value];
  CyclesTraits traits;
  traits.pane = std::holds_alternative<ThinDielectricDescription>(bsdf.model);
  traits.clear = traits.pane || std::holds_alternative<ConductorDescription>(bsdf.model) ||
                 std::holds_alternative<DielectricDescription>(bsdf.model);
  const auto* metal = std::get_if<RoughConductorDescription>(&bsdf.model);
  traits.chance = (metal && metal->ior) || std::holds_alternative<RoughDielectricDescription>(bsdf.model) ||
                  std::holds_alternative<PlasticDescription>(bsdf.model) ||
                  std::holds_alternative<PhongDescription>(bsdf.model);
  traits.clear |= traits.chance;
  traits.wide = std::holds_alternative<DiffuseDescription>(bsdf.model) ||
                std::holds_alternative<RoughConductorDescription>(bsdf.model);
  for (const BsdfIndex inner : nested_bsdfs(bsdf)) {
    const CyclesTraits nested = traits_of(scene, inner);
    traits.pane |= nested.pane;
    traits.clear |= nested.clear;
    traits.chance |= nested.chance;
    traits.wide |= nested.wide;
  }
  return traits;
}

}  // namespace photonproof::inline reference_cycles
