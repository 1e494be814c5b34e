// Textures and BSDFs as a scene file says them (description.h).
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenes/description/transform.h"
#include "scenes/images/image.h"
#include "scenes/meshes/vec.h"
#include "scenes/text/input_error.h"

namespace photonproof {

/// A typed index into one of SceneDescription's tables.
template <class Tag>
struct Index {
  std::uint32_t value = 0;
  friend auto operator<=>(const Index&, const Index&) = default;
};
using BsdfIndex = Index<struct BsdfTag>;
using TextureIndex = Index<struct TextureTag>;
using MediumIndex = Index<struct MediumTag>;
using ShapeGroupIndex = Index<struct ShapeGroupTag>;

// --- Textures --------------------------------------------------------------------------------------------------------

/// A colour, or the texture that gives one at every point.
using Colour = std::variant<RgbD, TextureIndex>;
/// A number, or the texture whose luminance (Rec. 709) gives one at every point.
using Scalar = std::variant<double, TextureIndex>;

/// The colour of what is known to be no texture.
inline const RgbD& constant(const Colour& colour) { return std::get<RgbD>(colour); }

enum class TextureFilter { bilinear, nearest };
enum class TextureWrap { repeat, mirror, clamp };

/// An image over the unit square of uv; its first row is at v = 0, as in Mitsuba.
struct BitmapDescription {
  std::string filename;                ///< as the scene spells it
  std::shared_ptr<const Image> image;  ///< never null, linear; shared by the textures that name the same file
  bool raw = false;                    ///< 8-bit values are numbers, not sRGB
  TextureFilter filter = TextureFilter::bilinear;
  TextureWrap wrap = TextureWrap::repeat;
  Transform to_uv;  ///< applied to uv before the look-up; its x and y rows count
  friend bool operator==(const BitmapDescription& a, const BitmapDescription& b) {
    return a.filename == b.filename && a.raw == b.raw && a.filter == b.filter && a.wrap == b.wrap && a.to_uv == b.to_uv;
  }
};

/// Two colours in turn on squares of half a unit of uv: color0 where both halves agree.
struct CheckerboardDescription {
  Colour color0 = RgbD(0.4), color1 = RgbD(0.2);
  Transform to_uv;
  friend bool operator==(const CheckerboardDescription&, const CheckerboardDescription&) = default;
};

struct TextureDescription {
  SourceLoc loc;
  std::string id;  ///< empty when unnamed
  std::variant<BitmapDescription, CheckerboardDescription> pattern;
};

// --- BSDFs -----------------------------------------------------------------------------------------------------------

struct ComplexIor {
  RgbD eta, k;
  friend bool operator==(const ComplexIor&, const ComplexIor&) = default;
};

enum class MicrofacetDistribution { beckmann, ggx };

/// Lambertian, one-sided: black from behind (the side its normal does not point to).
struct DiffuseDescription {
  Colour reflectance = RgbD(0.5);
  friend bool operator==(const DiffuseDescription&, const DiffuseDescription&) = default;
};

/// Smooth conductor, one-sided. Without `ior` it reflects `specular_reflectance` at every angle (material "none").
struct ConductorDescription {
  std::optional<ComplexIor> ior;
  Colour specular_reflectance = RgbD(1.0);
  friend bool operator==(const ConductorDescription&, const ConductorDescription&) = default;
};

struct RoughConductorDescription {
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  Scalar alpha_u = 0.1, alpha_v = 0.1;  ///< roughness along the tangents dp/du and dp/dv
  bool sample_visible = true;
  std::optional<ComplexIor> ior;
  Colour specular_reflectance = RgbD(1.0);
  friend bool operator==(const RoughConductorDescription&, const RoughConductorDescription&) = default;
};

/// Smooth dielectric; the normal points to the exterior.
struct DielectricDescription {
  double int_ior = 1.5046;    // bk7
  double ext_ior = 1.000277;  // air
  Colour specular_reflectance = RgbD(1.0);
  Colour specular_transmittance = RgbD(1.0);
  /// Extension, for bodies that overlap (Schmidt and Budge 2002): inside several, the highest priority's index and
  /// medium count. Without it the surface always separates int_ior from ext_ior.
  std::optional<int> priority = {};
  friend bool operator==(const DielectricDescription&, const DielectricDescription&) = default;
};

/// A pane: both interfaces at once, without the sideways shift.
struct ThinDielectricDescription {
  double int_ior = 1.5046, ext_ior = 1.000277;
  Colour specular_reflectance = RgbD(1.0), specular_transmittance = RgbD(1.0);
  friend bool operator==(const ThinDielectricDescription&, const ThinDielectricDescription&) = default;
};

struct RoughDielectricDescription {
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  Scalar alpha_u = 0.1, alpha_v = 0.1;
  bool sample_visible = true;
  double int_ior = 1.5046, ext_ior = 1.000277;
  Colour specular_reflectance = RgbD(1.0), specular_transmittance = RgbD(1.0);
  friend bool operator==(const RoughDielectricDescription&, const RoughDielectricDescription&) = default;
};

/// Diffuse below a smooth dielectric boundary.
struct PlasticDescription {
  Colour diffuse_reflectance = RgbD(0.5), specular_reflectance = RgbD(1.0);
  double int_ior = 1.49, ext_ior = 1.000277;  // polypropylene, air
  bool nonlinear = false;                     ///< colours shift with every internal reflection
  friend bool operator==(const PlasticDescription&, const PlasticDescription&) = default;
};

struct RoughPlasticDescription {
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  double alpha = 0.1;
  bool sample_visible = true;
  Colour diffuse_reflectance = RgbD(0.5), specular_reflectance = RgbD(1.0);
  double int_ior = 1.49, ext_ior = 1.000277;
  bool nonlinear = false;
  friend bool operator==(const RoughPlasticDescription&, const RoughPlasticDescription&) = default;
};

/// Modified Phong (Lafortune and Willems 1994), parameters of Mitsuba 0.6.
struct PhongDescription {
  Scalar exponent = 30.0;
  Colour diffuse_reflectance = RgbD(0.5), specular_reflectance = RgbD(0.2);
  friend bool operator==(const PhongDescription&, const PhongDescription&) = default;
};

/// Extension: a clear or tinted lacquer over any opaque reflecting BSDF.
struct LayeredDescription {
  BsdfIndex base;
  double int_ior = 1.5046, ext_ior = 1.000277;  ///< of the lacquer and of what is above it
  RgbD sigma_a{0.0};                            ///< absorption of the lacquer, per scene unit
  double thickness = 1;                         ///< scene units
  Colour specular_reflectance = RgbD(1.0);
  friend bool operator==(const LayeredDescription&, const LayeredDescription&) = default;
};

struct TwoSidedDescription {
  BsdfIndex front, back;
  friend bool operator==(const TwoSidedDescription&, const TwoSidedDescription&) = default;
};

/// `nested` where the surface is there, nothing where it is not.
struct MaskDescription {
  Scalar opacity = 0.5;
  BsdfIndex nested;
  friend bool operator==(const MaskDescription&, const MaskDescription&) = default;
};

/// first x (1 - weight) + second x weight.
struct BlendDescription {
  Scalar weight = 0.5;
  BsdfIndex first, second;
  friend bool operator==(const BlendDescription&, const BlendDescription&) = default;
};

/// No surface: a border between media.
struct NullDescription {
  friend bool operator==(const NullDescription&, const NullDescription&) = default;
};

/// What Mitsuba 3.7.1 and later do with normals that are not the surface's own.
struct MappedNormalsDescription {
  bool flip_invalid_normals = true;    ///< a normal that is turned away from the viewer is mirrored to face them
  bool use_shadowing_function = true;  ///< bumps shadow each other
  friend bool operator==(const MappedNormalsDescription&, const MappedNormalsDescription&) = default;
};

/// Displaces the shading normal by the gradient of a height texture, `scale` times.
struct BumpMapDescription {
  TextureIndex height;
  double scale = 1;
  BsdfIndex nested;
  MappedNormalsDescription normal_options{};
  friend bool operator==(const BumpMapDescription&, const BumpMapDescription&) = default;
};

/// Shading normals from a raw texture, n = 2 rgb - 1 in the frame of dp/du.
struct NormalMapDescription {
  TextureIndex normals;
  BsdfIndex nested;
  MappedNormalsDescription normal_options{};
  friend bool operator==(const NormalMapDescription&, const NormalMapDescription&) = default;
};

struct BsdfDescription {
  SourceLoc loc;
  std::string id;  ///< empty when unnamed
  /// A BSDF comes after the ones it nests.
  std::variant<DiffuseDescription, ConductorDescription, DielectricDescription, RoughConductorDescription,
               ThinDielectricDescription, RoughDielectricDescription, PlasticDescription, RoughPlasticDescription,
               PhongDescription, LayeredDescription, TwoSidedDescription, MaskDescription, BlendDescription,
               NullDescription, BumpMapDescription, NormalMapDescription>
      model;
};

/// What only chooses or turns other BSDFs and has no record.
template <class Description>
concept WrappingBsdf = std::same_as<Description, TwoSidedDescription> || std::same_as<Description, MaskDescription> ||
    std::same_as<Description, BlendDescription> || std::same_as<Description, BumpMapDescription> ||
    std::same_as<Description, NormalMapDescription>;
template <class Description>
concept LeafBsdf = !WrappingBsdf<Description>;

/// The BSDFs that one nests, in the order of its description.
std::vector<BsdfIndex> nested_bsdfs(const BsdfDescription& bsdf);

}  // namespace photonproof
