#include "renderer/bsdfs/compile_bsdf.h"

#include <cstddef>

#include "renderer/bsdfs/interface_tables.h"
#include "scenes/text/faults.h"

namespace photonproof {
namespace {

/// Makes one record, collecting the slots of its textures. `word` arguments are offsets in bytes.
class Compiler {
 public:
  Compiler(const SceneDescription& scene, const BsdfDescription& bsdf) : scene_(scene), bsdf_(bsdf) {}

  std::vector<TextureSlot> slots;

  Bsdf operator()(const DiffuseDescription& d) { return diffuse(d); }
  Bsdf operator()(const ConductorDescription& d) { return conductor(d); }
  Bsdf operator()(const RoughConductorDescription& d) { return rough_conductor(d); }
  Bsdf operator()(const PhongDescription& d) { return phong(d); }
  Bsdf operator()(const NullDescription&) { return NullBsdf<float>{}; }
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
    return Record{ratio(d.int_ior, d.ext_ior), static_cast<float>(diffuse_fresnel_reflectance(d.ext_ior / d.int_ior)),
                  d.nonlinear ? 1.0f : 0.0f, colour(d.diffuse_reflectance, offsetof(Record, diffuse)),
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
    record.internal_reflectance = interface.internal_reflectance;
    std::copy(interface.through.begin(), interface.through.end(), record.through);
    return record;
  }
  Bsdf operator()(const LayeredDescription& d) {
    const auto& base = scene_.bsdfs[d.base.value].model;
    if (const auto* m = std::get_if<DiffuseDescription>(&base)) return layered<DiffuseBsdf>(d, diffuse(*m));
    if (const auto* m = std::get_if<ConductorDescription>(&base))
      return layered<ConductorBsdf>(d, conductor(*m, d.int_ior));
    if (const auto* m = std::get_if<RoughConductorDescription>(&base))
      return layered<RoughConductorBsdf>(d, rough_conductor(*m, d.int_ior));
    if (const auto* m = std::get_if<PhongDescription>(&base)) return layered<PhongBsdf>(d, phong(*m));
    refuse("layered: the base must be diffuse, conductor, roughconductor or phong");
  }
  template <class Wrapper>
  Bsdf operator()(const Wrapper&) {
    refuse("this BSDF only works by others and has no record of its own");
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw InputError(scene_.where(bsdf_.loc), why); }
  void refuse_equal(double int_ior, double ext_ior) const {
    if (ratio(int_ior, ext_ior) == 1) refuse("int_ior and ext_ior must differ");
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
  /// What a metal reflects depends on its index relative to what lies on it.
  template <class Record>
  static void set_ior(Record& record, const std::optional<ComplexIor>& ior, double ior_above) {
    if (!ior) return;
    record.has_ior = 1;
    record.eta = Rgb(ior->eta / ior_above);
    record.k = Rgb(ior->k / ior_above);
  }
  PhongBsdf<float> phong(const PhongDescription& d) {
    using Record = PhongBsdf<float>;
    return {number(d.exponent, offsetof(Record, raw_exponent)),
            colour(d.diffuse_reflectance, offsetof(Record, raw_diffuse)),
            colour(d.specular_reflectance, offsetof(Record, raw_specular))};
  }
  template <template <class> class Base>
  Bsdf layered(const LayeredDescription& d, const Base<float>& base) {
    using Record = LayeredBsdf<float, Base>;
    const RgbD depth = d.sigma_a * d.thickness;
    const auto back = [&](double channel) {
      return static_cast<float>(diffuse_fresnel_reflectance(d.ext_ior / d.int_ior, channel));
    };
    return Record{base,
                  ratio(d.int_ior, d.ext_ior),
                  Rgb(depth),
                  {back(depth.x), back(depth.y), back(depth.z)},
                  colour(d.specular_reflectance, offsetof(Record, specular))};
  }

  const SceneDescription& scene_;
  const BsdfDescription& bsdf_;
};

struct Nested {
  std::vector<BsdfIndex> operator()(const TwoSidedDescription& d) const { return {d.front, d.back}; }
  std::vector<BsdfIndex> operator()(const MaskDescription& d) const { return {d.nested}; }
  std::vector<BsdfIndex> operator()(const BlendDescription& d) const { return {d.first, d.second}; }
  std::vector<BsdfIndex> operator()(const BumpMapDescription& d) const { return {d.nested}; }
  std::vector<BsdfIndex> operator()(const NormalMapDescription& d) const { return {d.nested}; }
  std::vector<BsdfIndex> operator()(const LayeredDescription& d) const { return {d.base}; }
  template <class Leaf>
  std::vector<BsdfIndex> operator()(const Leaf&) const {
    return {};
  }
};

}  // namespace

std::vector<BsdfIndex> nested_bsdfs(const BsdfDescription& bsdf) { return std::visit(Nested{}, bsdf.model); }

bool is_anisotropic(const SceneDescription& scene, BsdfIndex bsdf) {
  const auto& model = scene.bsdfs.at(bsdf.value).model;
  if (const auto* metal = std::get_if<RoughConductorDescription>(&model)) return metal->alpha_u != metal->alpha_v;
  if (const auto* glass = std::get_if<RoughDielectricDescription>(&model)) return glass->alpha_u != glass->alpha_v;
  if (const auto* lacquer = std::get_if<LayeredDescription>(&model)) return is_anisotropic(scene, lacquer->base);
  return false;
}

CompiledBsdf compile_bsdf(const SceneDescription& scene, BsdfIndex bsdf) {
  const BsdfDescription& description = scene.bsdfs[bsdf.value];
  Compiler compiler(scene, description);
  Bsdf record = std::visit(compiler, description.model);
  return {record, std::move(compiler.slots)};
}

}  // namespace photonproof
