// BSDFs as a scene file states them.
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/description/given_bool.h"
#include "scenes/description/texture_description.h"

namespace photonproof::inline scenes_description {

/// Facts of a kind of BSDF on which other code decides, without those of nested BSDFs. A kind whose parameters decide
/// them has a function `traits()`.
struct BsdfTraits {
  GivenBool transmits;  ///< Light passes through.
  GivenBool specular;   ///< Turns some light into a single direction: mirrors, smooth glass, clear coats.
  GivenBool refracts;   ///< Bends transmitted light.
  /// Focuses light into relevant caustics. Plastic and lacquer do not: their base dims the light that their thin gloss
  /// could focus.
  GivenBool focuses;
  GivenBool shows_others;  ///< A camera sees the mirrored or transmitted scene rather than the surface itself.
};

struct ComplexIor {
  RgbD eta, k;
  friend bool operator==(const ComplexIor&, const ComplexIor&) = default;
};

enum class MicrofacetDistribution { beckmann, ggx };

/// Lambertian, one-sided: black from behind (the side its normal does not point to).
struct DiffuseDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = false, .refracts = false, .focuses = false, .shows_others = false};
  Colour reflectance = RgbD(0.5);
  friend bool operator==(const DiffuseDescription&, const DiffuseDescription&) = default;
};

template <class P>
void describe(P& p, DiffuseDescription& d) {
  p.plugin("diffuse", "Lambertian, black from behind");
  p.colour_map("reflectance", d.reflectance, scene_xml::kShare, "albedo");
}

/// Smooth conductor, one-sided. Without `ior` it reflects `specular_reflectance` at every angle (material "none").
struct ConductorDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = true, .refracts = false, .focuses = true, .shows_others = true};
  std::optional<ComplexIor> ior;
  Colour specular_reflectance = RgbD(1.0);
  friend bool operator==(const ConductorDescription&, const ConductorDescription&) = default;
};

template <class P>
void describe_specular(P& p, Colour& reflectance) {
  p.colour_map("specular_reflectance", reflectance, scene_xml::kShare, "factor of what is mirrored");
}

template <class P>
void describe(P& p, ConductorDescription& d) {
  p.plugin("conductor", "smooth metal, black from behind");
  p.metal(d.ior);
  describe_specular(p, d.specular_reflectance);
}

struct RoughConductorDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = false, .refracts = false, .focuses = true, .shows_others = true};
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  Scalar alpha_u = 0.1, alpha_v = 0.1;  ///< roughness along the tangents dp/du and dp/dv
  bool sample_visible = true;
  std::optional<ComplexIor> ior;
  Colour specular_reflectance = RgbD(1.0);
  friend bool operator==(const RoughConductorDescription&, const RoughConductorDescription&) = default;
};

template <class P, class Rough>
void describe_facets(P& p, Rough& d) {
  p.choice("distribution", d.distribution,
           {{"beckmann", MicrofacetDistribution::beckmann}, {"ggx", MicrofacetDistribution::ggx}},
           "distribution of the microfacets' normals");
  p.boolean("sample_visible", d.sample_visible, "draws the normals that are seen");
}

template <class P>
void describe(P& p, RoughConductorDescription& d) {
  p.plugin("roughconductor", "rough metal, black from behind");
  describe_facets(p, d);
  p.roughness(d.alpha_u, d.alpha_v);
  p.metal(d.ior);
  describe_specular(p, d.specular_reflectance);
}

/// Smooth dielectric; the normal points to the exterior.
struct DielectricDescription {
  static constexpr BsdfTraits traits{
      .transmits = true, .specular = true, .refracts = true, .focuses = true, .shows_others = true};
  double int_ior = 1.5046;    // bk7
  double ext_ior = 1.000277;  // air
  Colour specular_reflectance = RgbD(1.0);
  Colour specular_transmittance = RgbD(1.0);
  /// Extension, for bodies that overlap (Schmidt and Budge 2002): where several overlap, the index and medium of the
  /// highest priority count. Without it the surface always separates int_ior from ext_ior.
  std::optional<int> priority = {};
  friend bool operator==(const DielectricDescription&, const DielectricDescription&) = default;
};

template <class P, class Interface>
void describe_iors(P& p, Interface& d) {
  p.ior("int_ior", d.int_ior, "index of refraction behind the surface");
  p.ior("ext_ior", d.ext_ior, "index of refraction before it");
}

template <class P>
void describe_transmitted(P& p, Colour& transmittance) {
  p.colour_map("specular_transmittance", transmittance, scene_xml::kShare, "factor of what is refracted");
}

template <class P>
void describe(P& p, DielectricDescription& d) {
  p.plugin("dielectric", "smooth glass; normals point outside");
  describe_iors(p, d);
  describe_specular(p, d.specular_reflectance);
  describe_transmitted(p, d.specular_transmittance);
  p.optional_integer("priority", d.priority, 0, 1'000'000, "extension: where bodies overlap, the highest counts");
}

/// A pane: both interfaces at once, without the sideways shift.
struct ThinDielectricDescription {
  static constexpr BsdfTraits traits{
      .transmits = true, .specular = true, .refracts = false, .focuses = true, .shows_others = true};
  double int_ior = 1.5046, ext_ior = 1.000277;
  Colour specular_reflectance = RgbD(1.0), specular_transmittance = RgbD(1.0);
  friend bool operator==(const ThinDielectricDescription&, const ThinDielectricDescription&) = default;
};

template <class P>
void describe(P& p, ThinDielectricDescription& d) {
  p.plugin("thindielectric", "a pane: both sides at once");
  describe_iors(p, d);
  describe_specular(p, d.specular_reflectance);
  describe_transmitted(p, d.specular_transmittance);
}

struct RoughDielectricDescription {
  static constexpr BsdfTraits traits{
      .transmits = true, .specular = false, .refracts = true, .focuses = true, .shows_others = true};
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  Scalar alpha_u = 0.1, alpha_v = 0.1;
  bool sample_visible = true;
  double int_ior = 1.5046, ext_ior = 1.000277;
  Colour specular_reflectance = RgbD(1.0), specular_transmittance = RgbD(1.0);
  friend bool operator==(const RoughDielectricDescription&, const RoughDielectricDescription&) = default;
};

template <class P>
void describe(P& p, RoughDielectricDescription& d) {
  p.plugin("roughdielectric", "rough glass; normals point outside");
  describe_facets(p, d);
  p.roughness(d.alpha_u, d.alpha_v);
  describe_iors(p, d);
  describe_specular(p, d.specular_reflectance);
  describe_transmitted(p, d.specular_transmittance);
}

/// Diffuse below a smooth dielectric boundary.
struct PlasticDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = true, .refracts = false, .focuses = false, .shows_others = false};
  Colour diffuse_reflectance = RgbD(0.5), specular_reflectance = RgbD(1.0);
  double int_ior = 1.49, ext_ior = 1.000277;  // polypropylene, air
  bool nonlinear = false;                     ///< colours shift with every internal reflection
  bool fitted_inside = false;                 ///< the coat reflects from below by Mitsuba's fit (as_mitsuba.h)
  friend bool operator==(const PlasticDescription&, const PlasticDescription&) = default;
};

template <class P, class Plastic>
void describe_plastic(P& p, Plastic& d) {
  describe_iors(p, d);
  p.colour_map("diffuse_reflectance", d.diffuse_reflectance, scene_xml::kShare, "albedo below the coat");
  describe_specular(p, d.specular_reflectance);
  p.boolean("nonlinear", d.nonlinear, "colours shift with every reflection inside");
}

template <class P>
void describe(P& p, PlasticDescription& d) {
  p.plugin("plastic", "diffuse below a smooth clear coat");
  describe_plastic(p, d);
}

struct RoughPlasticDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = false, .refracts = false, .focuses = false, .shows_others = false};
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  double alpha = 0.1;
  bool sample_visible = true;
  Colour diffuse_reflectance = RgbD(0.5), specular_reflectance = RgbD(1.0);
  double int_ior = 1.49, ext_ior = 1.000277;
  bool nonlinear = false;
  friend bool operator==(const RoughPlasticDescription&, const RoughPlasticDescription&) = default;
};

template <class P>
void describe(P& p, RoughPlasticDescription& d) {
  p.plugin("roughplastic", "diffuse below a rough clear coat");
  describe_facets(p, d);
  p.positive("alpha", d.alpha, "roughness");
  describe_plastic(p, d);
}

/// Modified Phong (Lafortune and Willems 1994), parameters of Mitsuba 0.6.
struct PhongDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = false, .refracts = false, .focuses = false, .shows_others = false};
  Scalar exponent = 30.0;
  Colour diffuse_reflectance = RgbD(0.5), specular_reflectance = RgbD(0.2);
  /// Names and colours that may add up to 1. A larger sum is rendered divided by itself.
  std::array<std::pair<const char*, Colour>, 2> shares() const {
    return {{{"diffuse_reflectance", diffuse_reflectance}, {"specular_reflectance", specular_reflectance}}};
  }
  friend bool operator==(const PhongDescription&, const PhongDescription&) = default;
};

template <class P>
void describe(P& p, PhongDescription& d) {
  p.plugin("phong", "extension: modified Phong, parameters of Mitsuba 0.6");
  p.number_map("exponent", d.exponent, scene_xml::kNotNegative, "exponent of the cosine to the mirror direction");
  p.colour_map("diffuse_reflectance", d.diffuse_reflectance, scene_xml::kShare, "albedo of the diffuse part");
  p.colour_map("specular_reflectance", d.specular_reflectance, scene_xml::kShare, "albedo of the glossy part");
}

/// Extension: a clear or tinted lacquer over any opaque reflecting BSDF.
struct LayeredDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = true, .refracts = false, .focuses = false, .shows_others = false};
  BsdfIndex base;
  double int_ior = 1.5046, ext_ior = 1.000277;  ///< indices of the lacquer and of the medium above it
  RgbD sigma_a{0.0};                            ///< absorption of the lacquer, per scene unit
  double thickness = 1;                         ///< in scene units
  Colour specular_reflectance = RgbD(1.0);
  friend bool operator==(const LayeredDescription&, const LayeredDescription&) = default;
};

template <class P>
void describe(P& p, LayeredDescription& d) {
  p.plugin("layered", "extension: a lacquer; `eta` and `k` of a metal below are its own, seen through the lacquer");
  describe_iors(p, d);
  p.colour("sigma_a", d.sigma_a, scene_xml::kNotNegative, "absorption of the lacquer, per scene unit");
  p.number("thickness", d.thickness, scene_xml::kNotNegative, "scene units");
  describe_specular(p, d.specular_reflectance);
  p.bsdf(d.base, "a BSDF that neither transmits nor nests");
}

struct TwoSidedDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = false, .refracts = false, .focuses = false, .shows_others = false};
  BsdfIndex front, back;
  friend bool operator==(const TwoSidedDescription&, const TwoSidedDescription&) = default;
};

template <class P>
void describe(P& p, TwoSidedDescription& d) {
  p.plugin("twosided", "shows itself, or the second, behind too");
  p.one_or_two_bsdfs(d.front, d.back, "one or two BSDFs that do not transmit");
}

/// `nested` on the share `opacity` of the surface, no surface elsewhere.
struct MaskDescription {
  static constexpr BsdfTraits traits{
      .transmits = true, .specular = false, .refracts = false, .focuses = false, .shows_others = false};
  Scalar opacity = 0.5;
  BsdfIndex nested;
  friend bool operator==(const MaskDescription&, const MaskDescription&) = default;
};

template <class P>
void describe(P& p, MaskDescription& d) {
  p.plugin("mask", "holes");
  p.number_map("opacity", d.opacity, scene_xml::kShare, "share of the surface that is there");
  p.bsdf(d.nested, "a BSDF");
}

/// first x (1 - weight) + second x weight.
struct BlendDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = false, .refracts = false, .focuses = false, .shows_others = false};
  Scalar weight = 0.5;
  BsdfIndex first, second;
  bool mixes_mirrors = false;  ///< a mirror's sample is weighted against the other BSDF's density (as_mitsuba.h)
  friend bool operator==(const BlendDescription&, const BlendDescription&) = default;
};

template <class P>
void describe(P& p, BlendDescription& d) {
  p.plugin("blendbsdf", "a mixture");
  p.require("weight", "a number or a texture");
  p.number_map("weight", d.weight, scene_xml::kShare, "share of the second");
  p.two_bsdfs(d.first, d.second, "two BSDFs");
}

/// No surface: a boundary between media.
struct NullDescription {
  static constexpr BsdfTraits traits{
      .transmits = true, .specular = false, .refracts = false, .focuses = false, .shows_others = true};
  friend bool operator==(const NullDescription&, const NullDescription&) = default;
};

template <class P>
void describe(P& p, NullDescription&) {
  p.plugin("null", "no surface, a border between media");
}

/// Rules of Mitsuba 3.7.1 and later for shading normals that differ from the surface's own.
struct MappedNormalsDescription {
  bool flip_invalid_normals = true;    ///< a normal that points away from the viewer is mirrored to face them
  bool use_shadowing_function = true;  ///< bumps shadow each other
  friend bool operator==(const MappedNormalsDescription&, const MappedNormalsDescription&) = default;
};

/// Displaces the shading normal by the gradient of a height texture, `scale` times.
struct BumpMapDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = false, .refracts = false, .focuses = false, .shows_others = false};
  TextureIndex height;
  double scale = 1;
  BsdfIndex nested;
  MappedNormalsDescription normal_options{};
  friend bool operator==(const BumpMapDescription&, const BumpMapDescription&) = default;
};

template <class P>
void describe_maps(P& p, MappedNormalsDescription& d) {
  p.boolean("flip_invalid_normals", d.flip_invalid_normals, "mirrors normals that are turned away from the viewer");
  p.boolean("use_shadowing_function", d.use_shadowing_function, "bumps shadow each other");
}

template <class P>
void describe(P& p, BumpMapDescription& d) {
  p.plugin("bumpmap", "normals of the surface that a texture displaces");
  p.nested_texture(d.height, "a texture");
  p.number("scale", d.scale, scene_xml::kAny, "factor of the texture's heights");
  describe_maps(p, d.normal_options);
  p.bsdf(d.nested, "a BSDF");
}

/// Shading normals from a raw texture, n = 2 rgb - 1 in the frame of dp/du.
struct NormalMapDescription {
  static constexpr BsdfTraits traits{
      .transmits = false, .specular = false, .refracts = false, .focuses = false, .shows_others = false};
  TextureIndex normals;
  BsdfIndex nested;
  MappedNormalsDescription normal_options{};
  friend bool operator==(const NormalMapDescription&, const NormalMapDescription&) = default;
};

template <class P>
void describe(P& p, NormalMapDescription& d) {
  p.plugin("normalmap", "normals from a texture");
  p.require("normalmap", "a texture");
  p.texture("normalmap", d.normals, "n = 2 rgb - 1 in the frame of dp/du");
  describe_maps(p, d.normal_options);
  p.bsdf(d.nested, "a BSDF");
}

/// Burley's principled BSDF (Burley 2012, 2015), one-sided where it lets no light through.
struct PrincipledDescription {
  Colour base_color = RgbD(0.5);
  Scalar roughness = 0.5, anisotropic = 0.0, metallic = 0.0, spec_trans = 0.0;
  std::optional<double> eta = {};  ///< Interior ior / exterior ior; without it `specular` counts.
  double specular = 0.5;           ///< Reflectance at normal incidence is 0.08 times it.
  Scalar spec_tint = 0.0, sheen = 0.0, sheen_tint = 0.0, flatness = 0.0, clearcoat = 0.0, clearcoat_gloss = 0.0;
  double diffuse_rate = 1, specular_rate = 1, clearcoat_rate = 1;  ///< weights of the lobes in sampling

  bool transmits() const { return spec_trans != Scalar(0.0); }
  BsdfTraits traits() const {
    const bool clear = transmits() || metallic != Scalar(0.0);
    return {
        .transmits = transmits(), .specular = false, .refracts = transmits(), .focuses = clear, .shows_others = clear};
  }
  friend bool operator==(const PrincipledDescription&, const PrincipledDescription&) = default;
};

/// The parameters that both principled BSDFs have.
template <class P, class Principled>
void describe_principled(P& p, Principled& d) {
  p.colour_map("base_color", d.base_color, scene_xml::kShare, "colour of base, metal and transmission");
  p.number_map("roughness", d.roughness, scene_xml::kShare, "root of the microfacets' alpha");
  p.number_map("anisotropic", d.anisotropic, scene_xml::kShare, "stretches highlights along dp/du");
  p.number_map("spec_tint", d.spec_tint, scene_xml::kShare, "share of the highlight that has the base's hue");
  p.number_map("sheen", d.sheen, scene_xml::kShare, "retroreflection of cloth");
  p.number_map("sheen_tint", d.sheen_tint, scene_xml::kShare, "share of the sheen that has the base's hue");
  p.number_map("flatness", d.flatness, scene_xml::kShare, "0 is diffuse, 1 imitates subsurface scattering");
}

template <class P>
void describe(P& p, PrincipledDescription& d) {
  p.plugin("principled", "Burley's model; black from behind where `spec_trans` is 0");
  describe_principled(p, d);
  p.number_map("metallic", d.metallic, scene_xml::kShare, "0 is dielectric, 1 is metal");
  p.number_map("spec_trans", d.spec_trans, scene_xml::kShare, "share of the dielectric that is glass");
  p.eta_or_specular(d.eta, d.specular);
  p.number_map("clearcoat", d.clearcoat, scene_xml::kShare, "a second highlight");
  p.number_map("clearcoat_gloss", d.clearcoat_gloss, scene_xml::kShare, "0 makes that one 0.1 wide, 1 makes it 0.001");
  p.number("diffuse_reflectance_sampling_rate", d.diffuse_rate, scene_xml::kNotNegative, "samples of the diffuse part");
  p.number("main_specular_sampling_rate", d.specular_rate, scene_xml::kNotNegative, "samples of highlight and glass");
  p.number("clearcoat_sampling_rate", d.clearcoat_rate, scene_xml::kNotNegative, "samples of the second highlight");
}

/// The principled BSDF of a sheet without thickness, the same from both sides.
struct PrincipledThinDescription {
  static constexpr BsdfTraits traits{
      .transmits = true, .specular = false, .refracts = false, .focuses = true, .shows_others = false};
  Colour base_color = RgbD(0.5);
  Scalar roughness = 0.5, anisotropic = 0.0, spec_trans = 0.0, eta = 1.5;
  Scalar spec_tint = 0.0, sheen = 0.0, sheen_tint = 0.0, flatness = 0.0;
  Scalar diff_trans = 0.0;  ///< 2: all diffuse light passes
  double diffuse_rate = 1, specular_rate = 1, transmitted_rate = 1, diffuse_transmitted_rate = 1;
  friend bool operator==(const PrincipledThinDescription&, const PrincipledThinDescription&) = default;
};

template <class P>
void describe(P& p, PrincipledThinDescription& d) {
  p.plugin("principledthin", "Burley's model of a sheet, the same from both sides");
  describe_principled(p, d);
  p.number_map("spec_trans", d.spec_trans, scene_xml::kShare, "share that is glass");
  p.number_map("eta", d.eta, {1e-3, 1e3}, "index of refraction of the sheet");
  p.number_map("diff_trans", d.diff_trans, {0, 2}, "2 lets all diffuse light through");
  p.number("diffuse_reflectance_sampling_rate", d.diffuse_rate, scene_xml::kNotNegative, "samples of the diffuse part");
  p.number("specular_reflectance_sampling_rate", d.specular_rate, scene_xml::kNotNegative, "samples of the highlight");
  p.number("specular_transmittance_sampling_rate", d.transmitted_rate, scene_xml::kNotNegative, "samples of the glass");
  p.number("diffuse_transmittance_sampling_rate", d.diffuse_transmitted_rate, scene_xml::kNotNegative,
           "samples of the diffuse light that passes");
}

/// Lambertian transmission, the same from both sides. Nothing is reflected.
struct DiffuseTransmitterDescription {
  static constexpr BsdfTraits traits{
      .transmits = true, .specular = false, .refracts = false, .focuses = false, .shows_others = false};
  Colour transmittance = RgbD(0.5);
  friend bool operator==(const DiffuseTransmitterDescription&, const DiffuseTransmitterDescription&) = default;
};

template <class P>
void describe(P& p, DiffuseTransmitterDescription& d) {
  p.plugin("difftrans", "extension: diffuse transmission, parameter of Mitsuba 0.6");
  p.colour_map("transmittance", d.transmittance, scene_xml::kShare, "share of light that passes");
}

struct BsdfDescription {
  SourceLoc loc;
  std::string id;  ///< empty when unnamed
  /// A BSDF comes after its nested BSDFs.
  std::variant<DiffuseDescription, ConductorDescription, DielectricDescription, RoughConductorDescription,
               ThinDielectricDescription, RoughDielectricDescription, PlasticDescription, RoughPlasticDescription,
               PhongDescription, LayeredDescription, TwoSidedDescription, MaskDescription, BlendDescription,
               NullDescription, BumpMapDescription, NormalMapDescription, PrincipledDescription,
               PrincipledThinDescription, DiffuseTransmitterDescription>
      model;
};

inline BsdfTraits traits_of(const BsdfDescription& bsdf) {
  return std::visit(
      []<class Model>(const Model& model) -> BsdfTraits {
        if constexpr (requires { model.traits(); })
          return model.traits();
        else
          return Model::traits;
      },
      bsdf.model);
}

/// BSDFs that only choose or turn other BSDFs and have no record.
template <class Description>
concept WrappingBsdf = std::same_as<Description, TwoSidedDescription> || std::same_as<Description, MaskDescription> ||
    std::same_as<Description, BlendDescription> || std::same_as<Description, BumpMapDescription> ||
    std::same_as<Description, NormalMapDescription>;
template <class Description>
concept LeafBsdf = !WrappingBsdf<Description>;

/// The BSDFs nested in one, in the order of its description.
std::vector<BsdfIndex> nested_bsdfs(const BsdfDescription& bsdf);

}  // namespace photonproof::inline scenes_description
