// Mitsuba 3's diffuse, conductor and dielectric; defaults are its.
#include <array>
#include <utility>

#include "scenes/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Model = decltype(BsdfDescription::model);

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

Model build_diffuse(Params& params) { return DiffuseDescription{params.colour("reflectance", RgbD(0.5), 0, 1)}; }

Model build_conductor(Params& params) {
  const std::string supported = "expected material \"none\" (a perfect mirror), or eta and k as <rgb> or <float>";
  ConductorDescription conductor;
  conductor.specular_reflectance = params.colour("specular_reflectance", RgbD(1.0), 0, 1);
  const bool has_ior = params.has("eta") || params.has("k");
  if (params.has("material")) {
    const std::string material = params.string("material", "");
    params.expect(material == "none", "material",
                  "is " + in_quotes(material) + ", which is not supported: " + supported);
    params.expect(!has_ior, "material", "is given beside eta and k, expected one or the other");
    return conductor;
  }
  if (!has_ior) params.sources().fail(params.object().at, params.title() + " says no material: " + supported);
  for (const char* name : {"eta", "k"}) params.expect(params.has(name), name, "is missing: eta and k go together");
  ComplexIor ior{params.colour("eta", {}, 0, kUnbounded), params.colour("k", {}, 0, kUnbounded)};
  const RgbD sum = ior.eta + ior.k;
  params.expect(sum.x > 0 && sum.y > 0 && sum.z > 0, "eta", "and k are both 0 in a channel");
  conductor.ior = ior;
  return conductor;
}

/// Mitsuba's names for indices of refraction (its manual, table "ior-table-list"; after Hecht, Optics).
constexpr std::array<std::pair<const char*, double>, 23> kNamedIors = {
    {{"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
     {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
     {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
     {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
     {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
     {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
     {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
     {"pet", 1.5750},      {"diamond", 2.419}}};

double read_ior(Params& params, const std::string& name, double fallback) {
  if (params.tag(name) != "string") {
    return params.positive(name, fallback);
  }
  const std::string material = params.string(name, "");
  std::vector<std::string> names;
  for (const auto& [known, ior] : kNamedIors) {
    if (material == known) return ior;
    names.push_back(known);
  }
  params.fail(name,
              "is " + in_quotes(material) + did_you_mean(material, names) + ", expected a number or " + join_or(names));
}

Model build_dielectric(Params& params) {
  const DielectricDescription defaults;
  DielectricDescription dielectric;
  dielectric.int_ior = read_ior(params, "int_ior", defaults.int_ior);
  dielectric.ext_ior = read_ior(params, "ext_ior", defaults.ext_ior);
  dielectric.specular_reflectance = params.colour("specular_reflectance", RgbD(1.0), 0, 1);
  dielectric.specular_transmittance = params.colour("specular_transmittance", RgbD(1.0), 0, 1);
  return dielectric;
}

const std::vector<Plugin<Model>>& table() {
  static const std::vector<Plugin<Model>> rows = {
      {"conductor",
       {{"material", ParamType::string},
        {"eta", ParamType::colour},
        {"k", ParamType::colour},
        {"specular_reflectance", ParamType::colour}},
       {},
       build_conductor},
      {"dielectric",
       {{"int_ior", ParamType::ior},
        {"ext_ior", ParamType::ior},
        {"specular_reflectance", ParamType::colour},
        {"specular_transmittance", ParamType::colour}},
       {},
       build_dielectric},
      {"diffuse", {{"reflectance", ParamType::colour}}, {}, build_diffuse},
  };
  return rows;
}

}  // namespace

BsdfDescription read_bsdf(const Sources& sources, const Element& element) {
  return {sources.loc(element.at), id_of(element), build_plugin(sources, element, table())};
}

}  // namespace photonproof::scene_xml
