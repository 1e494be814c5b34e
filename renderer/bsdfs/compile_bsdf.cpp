#include "renderer/bsdfs/compile_bsdf.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "renderer/bsdfs/interface_tables.h"
#include "scenes/base/numeric_faults.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

/// Makes one record and collects the slots of its textures. `word` arguments are offsets in bytes.
class Compiler {
 public:
  Compiler(const SceneDescription& scene, const BsdfDescription& bsdf) : scene_(scene), bsdf_(bsdf) {}

  std::vector<TextureSlot> slots;

  Bsdf operator()(const DiffuseDescription& d) { return diffuse(d); }
  Bsdf operator()(const ConductorDescription& d) { return conductor(d); }
  Bsdf operator()(const RoughConductorDescription& d) { return rough_conductor(d); }
  Bsdf operator()(const PhongDescription& d) { return phong(d); }
  Bsdf operator()(const NullDescription&) { return NullBsdf<float>{}; }
  Bsdf operator()(const DiffuseTransmitterDescription& d) {
    using Record = DiffuseTransmitterBsdf<float>;
    return Record{colour(d.transmittance, offsetof(Record, transmittance))};
  }
  Bsdf operator()(const DielectricDescription& d) {
    using Record = DielectricBsdf<float>;
    return Record{has_fault(Fault::swapped_ior) ? ratio(d.ext_ior, d.int_ior) : ratio(d.int_ior, d.ext_ior),
                  colour(d.specular_reflectance, offsetof(Record, reflectance)),
                  colour(d.specular_transmittance, offsetof(Record, transmittance))};
  }
  Bsdf operator()(const ThinDielectricDescription& d) {
    using Record = ThinDielectricBsdf<float>;
    return Record{ratio(d.int_ior, d.ext_ior), colour(d.specular_reflectance, offsetof(Record, reflectance)),
                  colour(d.specular_transmittance, offsetof(Record, transmittance))};
  }
  Bsdf operator()(const RoughDielectricDescription& d) {
    using Record = RoughDielectricBsdf<float>;
    refuse_equal(d.int_ior, d.ext_ior);
    return Record{facets(d.distribution, d.alpha_u, d.alpha_v, d.sample_visible, offsetof(Record, facets)),
                  ratio(d.int_ior, d.ext_ior), colour(d.specular_reflectance, offsetof(Record, reflectance)),
                  colour(d.specular_transmittance, offsetof(Record, transmittance))};
  }
  Bsdf operator()(const PlasticDescription& d) {
    using Record = PlasticBsdf<float>;
    return Record{ratio(d.int_ior, d.ext_ior), static_cast<float>(lost_inside(d)), d.nonlinear ? 1.0f : 0.0f,
                  colour(d.diffuse_reflectance, offsetof(Record, diffuse)),
                  colour(d.specular_reflectance, offsetof(Record, specular))};
  }
  Bsdf operator()(const RoughPlasticDescription& d) {
    using Record = RoughPlasticBsdf<float>;
    refuse_equal(d.int_ior, d.ext_ior);
    Record record{facets(d.distribution, d.alpha, d.alpha, d.sample_visible, offsetof(Record, facets)),
                  ratio(d.int_ior, d.ext_ior),
                  0,
                  d.nonlinear ? 1.0f : 0.0f,
                  colour(d.diffuse_reflectance, offsetof(Record, diffuse)),
                  colour(d.specular_reflectance, offsetof(Record, specular)),
                  {}};
    const RoughInterface interface = rough_interface(record.facets, d.int_ior / d.ext_ior);
    record.lost_inside = interface.lost_inside;
    std::copy(interface.through.begin(), interface.through.end(), record.through);
    return record;
  }
  Bsdf operator()(const LayeredDescription& d) {
    return std::visit(Overloaded{[&](const DiffuseDescription& base) { return layered<DiffuseBsdf>(d, diffuse(base)); },
                                 [&](const ConductorDescription& base) {
                                   return layered<ConductorBsdf>(d, conductor(base, d.int_ior));
                                 },
                                 [&](const RoughConductorDescription& base) {
                                   return layered<RoughConductorBsdf>(d, rough_conductor(base, d.int_ior));
                                 },
                                 [&](const PhongDescription& base) { return layered<PhongBsdf>(d, phong(base)); },
                                 [&](const auto&) -> Bsdf {
                                   refuse("layered: the base must be diffuse, conductor, roughconductor or phong");
                                 }},
                      scene_.bsdfs[d.base.value].model);
  }
  Bsdf operator()(const PrincipledDescription& d) {
    return d.transmits() ? Bsdf(principled<PrincipledGlassBsdf>(d)) : principled<PrincipledBsdf>(d);
  }
  Bsdf operator()(const PrincipledThinDescription& d) {
    using Record = PrincipledThinBsdf<float>;
    return Record{principled_base(d),
                  number(d.anisotropic, offsetof(Record, anisotropic)),
                  number(d.spec_trans, offsetof(Record, spec_trans)),
                  number(d.spec_tint, offsetof(Record, spec_tint)),
                  number(d.eta, offsetof(Record, raw_eta)),
                  number(d.diff_trans, offsetof(Record, diff_trans)),
                  static_cast<float>(d.diffuse_rate),
                  static_cast<float>(d.specular_rate),
                  static_cast<float>(d.transmitted_rate),
                  static_cast<float>(d.diffuse_transmitted_rate)};
  }
  Bsdf operator()(const WrappingBsdf auto&) { refuse("this BSDF only works by others and has no record of its own"); }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw InputError(scene_.where(bsdf_.loc), why); }
  /// The facet that sends light from one direction to the other follows from their difference. Single precision keeps
  /// no digits of it where the indices are a few rounding steps apart.
  void refuse_equal(double int_ior, double ext_ior,
                    const char* why = "int_ior and ext_ior must differ by 5e-7 of each other at least") const {
    constexpr float least = 4 * 0x1p-23f;
    if (std::abs(ratio(int_ior, ext_ior) - 1) < least) refuse(why);
  }
  static double lost_inside(const PlasticDescription& d) {
    const double eta = d.ext_ior / d.int_ior;
    return d.fitted_inside ? 1 - fitted_diffuse_reflectance(eta) : diffuse_fresnel_loss(eta);
  }
  static float ratio(double int_ior, double ext_ior) { return static_cast<float>(int_ior / ext_ior); }

  void slot(TextureIndex texture, std::size_t offset, bool is_colour) {
    slots.push_back({texture.value, static_cast<std::uint32_t>(offset / sizeof(float)), is_colour});
  }
  Rgb colour(const Colour& value, std::size_t offset) {
    if (const auto* rgb = std::get_if<RgbD>(&value)) return Rgb(*rgb);
    slot(std::get<TextureIndex>(value), offset, true);
    return Rgb(0.5f);
  }
  float number(const Scalar& value, std::size_t offset) {
    if (const auto* n = std::get_if<double>(&value)) return static_cast<float>(*n);
    slot(std::get<TextureIndex>(value), offset, false);
    return 0.5f;
  }
  Microfacets<float> facets(MicrofacetDistribution distribution, const Scalar& alpha_u, const Scalar& alpha_v,
                            bool sample_visible, std::size_t offset) {
    using Record = Microfacets<float>;
    return {number(alpha_u, offset + offsetof(Record, raw_alpha_u)),
            number(alpha_v, offset + offsetof(Record, raw_alpha_v)),
            distribution == MicrofacetDistribution::ggx ? 1.0f : 0.0f, sample_visible ? 1.0f : 0.0f};
  }

  DiffuseBsdf<float> diffuse(const DiffuseDescription& d) {
    return {colour(d.reflectance, offsetof(DiffuseBsdf<float>, reflectance))};
  }
  ConductorBsdf<float> conductor(const ConductorDescription& d, double ior_above = 1) {
    using Record = ConductorBsdf<float>;
    Record record{colour(d.specular_reflectance, offsetof(Record, reflectance)), 0, {}, {}};
    set_ior(record, d.ior, ior_above);
    return record;
  }
  RoughConductorBsdf<float> rough_conductor(const RoughConductorDescription& d, double ior_above = 1) {
    using Record = RoughConductorBsdf<float>;
    Record record{facets(d.distribution, d.alpha_u, d.alpha_v, d.sample_visible, offsetof(Record, facets)),
                  colour(d.specular_reflectance, offsetof(Record, reflectance)),
                  0,
                  {},
                  {}};
    set_ior(record, d.ior, ior_above);
    return record;
  }
  /// A metal's reflectance depends on its index relative to the medium that lies on it.
  template <class Record>
  static void set_ior(Record& record, const std::optional<ComplexIor>& ior, double ior_above) {
    if (!ior) return;
    record.has_ior = 1;
    // Beyond this all light is reflected, and fourth powers would overflow single precision.
    const double highest = has_fault(NumericFault::unclamped_metal) ? 1e38 : 1e9;
    const auto held = [&](const RgbD& index) {
      const auto part = [&](double v) { return static_cast<float>(std::min(v / ior_above, highest)); };
      return Rgb(part(index.x), part(index.y), part(index.z));
    };
    record.eta = held(ior->eta);
    record.k = held(ior->k);
  }
  PhongBsdf<float> phong(const PhongDescription& d) {
    using Record = PhongBsdf<float>;
    return {number(d.exponent, offsetof(Record, raw_exponent)),
            colour(d.diffuse_reflectance, offsetof(Record, raw_diffuse)),
            colour(d.specular_reflectance, offsetof(Record, raw_specular))};
  }
  template <class Principled>
  PrincipledBase<float> principled_base(const Principled& d) {  // the record's first words
    using Record = PrincipledBase<float>;
    return {colour(d.base_color, offsetof(Record, colour)), number(d.roughness, offsetof(Record, roughness)),
            number(d.flatness, offsetof(Record, flatness)), number(d.sheen, offsetof(Record, sheen)),
            number(d.sheen_tint, offsetof(Record, sheen_tint))};
  }
  template <template <class> class Kind>
  Kind<float> principled(const PrincipledDescription& d) {
    using Record = Kind<float>;
    const float eta = principled_eta(d);
    if (d.transmits())
      refuse_equal(static_cast<double>(eta), 1, "glass needs an index that differs from 1 by 5e-7 at least");
    return {principled_base(d),
            number(d.anisotropic, offsetof(Record, anisotropic)),
            number(d.metallic, offsetof(Record, metallic)),
            number(d.spec_trans, offsetof(Record, spec_trans)),
            number(d.spec_tint, offsetof(Record, spec_tint)),
            number(d.clearcoat, offsetof(Record, clearcoat)),
            number(d.clearcoat_gloss, offsetof(Record, clearcoat_gloss)),
            eta,
            static_cast<float>(d.diffuse_rate),
            static_cast<float>(d.specular_rate),
            static_cast<float>(d.clearcoat_rate)};
  }
  /// Glass of the same index as its surroundings is not plausible: Mitsuba takes the least values below instead.
  static float principled_eta(const PrincipledDescription& d) {
    if (d.eta) return d.transmits() && *d.eta == 1 ? 1.001f : static_cast<float>(*d.eta);
    const double specular = d.transmits() && d.specular == 0 ? 1e-3 : d.specular;
    return static_cast<float>(2 / (1 - std::sqrt(0.08 * specular)) - 1);
  }
  template <template <class> class Base>
  Bsdf layered(const LayeredDescription& d, const Base<float>& base) {
    using Record = LayeredBsdf<float, Base>;
    const RgbD depth = d.sigma_a * d.thickness;
    const auto lost = [&](double channel) {
      return static_cast<float>(diffuse_fresnel_loss(d.ext_ior / d.int_ior, channel));
    };
    return Record{base,
                  ratio(d.int_ior, d.ext_ior),
                  Rgb(depth),
                  {lost(depth.x), lost(depth.y), lost(depth.z)},
                  colour(d.specular_reflectance, offsetof(Record, specular))};
  }

  const SceneDescription& scene_;
  const BsdfDescription& bsdf_;
};

}  // namespace

bool is_anisotropic(const SceneDescription& scene, BsdfIndex bsdf) {
  return std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (std::is_same_v<Model, LayeredDescription>)
          return is_anisotropic(scene, model.base);
        else if constexpr (requires { model.alpha_u; })
          return model.alpha_u != model.alpha_v;
        else if constexpr (requires { model.anisotropic; })
          return model.anisotropic != Scalar(0.0);
        else
          return false;
      },
      scene.bsdfs.at(bsdf.value).model);
}

CompiledBsdf compile_bsdf(const SceneDescription& scene, BsdfIndex bsdf) {
  const BsdfDescription& description = scene.bsdfs[bsdf.value];
  Compiler compiler(scene, description);
  Bsdf record = std::visit(compiler, description.model);
  return {record, std::move(compiler.slots)};
}

}  // namespace photonproof::inline renderer_bsdfs
