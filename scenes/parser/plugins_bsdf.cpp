// Mitsuba 3's BSDFs, and the extensions phong and layered: rules that a description alone does not state.
#include "scenes/description/description.h"
#include "scenes/description/named_ior.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {

double read_ior(Params& params, const std::string& name, double fallback) {
  if (params.tag(name) != "string") {
    const double ior = params.positive(name, fallback);
    // Beyond any matter; single precision then holds no Fresnel term.
    params.expect(ior >= 1e-3 && ior <= 1e3, name, "is " + format_number(ior) + ", expected from 0.001 to 1000");
    return ior;
  }
  const std::string material = params.string(name, "");
  if (const auto ior = ior_named(material)) return *ior;
  const std::vector<std::string> names = ior_names();
  params.fail(name,
              "is " + in_quotes(material) + did_you_mean(material, names) + ", expected a number or " + join_or(names));
}

namespace {

std::optional<ComplexIor> read_conductor_in_vacuum(Params& params) {
  const std::string material = params.string("material", "none");
  if (params.has("eta") || params.has("k")) {
    params.expect(material == "none", "material", "is given beside eta and k, expected one or the other");
    const ComplexIor ior{params.colour("eta", RgbD(0.0), 0, kUnbounded), params.colour("k", RgbD(1.0), 0, kUnbounded)};
    const RgbD sum = ior.eta + ior.k;
    params.expect(sum.x > 0 && sum.y > 0 && sum.z > 0, "eta", "and k are both 0 in a channel");
    return ior;
  }
  if (material == "none") return std::nullopt;
  if (const auto ior = conductor_named(material)) return ior;
  std::vector<std::string> names = conductor_names();
  names.push_back("none");
  params.fail("material", "is " + in_quotes(material) + did_you_mean(material, names) + ", expected " + join_or(names));
}

}  // namespace

std::optional<ComplexIor> read_conductor_ior(Params& params) {
  std::optional<ComplexIor> ior = read_conductor_in_vacuum(params);
  const double outside = read_ior(params, "ext_eta", 1);
  if (ior) *ior = {ior->eta / outside, ior->k / outside};
  return ior;
}

namespace {

using BsdfModel = decltype(BsdfDescription::model);

/// Whether it nests no others.
bool is_plain(const BsdfModel& model) {
  return std::visit(
      []<class Model>(const Model&) { return LeafBsdf<Model> && !std::is_same_v<Model, LayeredDescription>; }, model);
}

struct CompleteBsdf {
  Params& params;

  void operator()(TwoSidedDescription& d) const {
    expect_opaque(d.front, 0);
    if (d.back != d.front) expect_opaque(d.back, 1);
  }
  void operator()(LayeredDescription& d) const {
    expect_opaque(d.base, 0);
    if (!is_plain(params.objects().scene().bsdfs[d.base.value].model))
      params.sources().fail(params.nested("bsdf")[0]->at,
                            params.title() + " has a base that nests other BSDFs, expected a plain one");
  }
  template <class Other>
  void operator()(Other&) const {}

 private:
  void expect_opaque(BsdfIndex index, std::size_t child) const {
    if (params.objects().transmits(index))
      params.sources().fail(params.nested("bsdf")[child]->at,
                            params.title() + " nests a BSDF that lets light through, expected one that reflects only");
  }
};

}  // namespace

BsdfDescription read_bsdf(SceneObjects& objects, const Element& element) {
  static const std::vector<Plugin<BsdfModel>> table = described_plugins<BsdfModel, CompleteBsdf>();
  return {objects.sources().loc(element.at), id_of(element), build_plugin(objects, element, table)};
}

}  // namespace photonproof::scene_xml
