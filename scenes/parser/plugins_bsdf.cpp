// Mitsuba 3's smooth BSDFs and null, and the extension phong; defaults are Mitsuba's, phong's those of Mitsuba 0.6.
#include "scenes/description/conductor_ior.h"
#include "scenes/description/named_ior.h"
#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {

double read_ior(Params& params, const std::string& name, double fallback) {
  if (params.tag(name) != "string") {
    const double ior = params.positive(name, fallback);
    // Beyond any matter, and single precision then holds no Fresnel term.
    params.expect(ior >= 1e-3 && ior <= 1e3, name, "is " + format_number(ior) + ", expected from 0.001 to 1000");
    return ior;
  }
  const std::string material = params.string(name, "");
  if (const auto ior = ior_named(material)) return *ior;
  const std::vector<std::string> names = ior_names();
  params.fail(name,
              "is " + in_quotes(material) + did_you_mean(material, names) + ", expected a number or " + join_or(names));
}

std::optional<ComplexIor> read_conductor_ior(Params& params) {
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

namespace {

const ParamSpec kReflectance{"specular_reflectance", ParamType::colour_map};
const ParamSpec kTransmittance{"specular_transmittance", ParamType::colour_map};
const ParamSpec kIntIor{"int_ior", ParamType::ior}, kExtIor{"ext_ior", ParamType::ior};

BsdfModel build_diffuse(Params& params) {
  return DiffuseDescription{params.colour_map("reflectance", RgbD(0.5), 0, 1)};
}

BsdfModel build_conductor(Params& params) {
  ConductorDescription conductor;
  conductor.ior = read_conductor_ior(params);
  conductor.specular_reflectance = params.colour_map("specular_reflectance", RgbD(1.0), 0, 1);
  return conductor;
}

template <class Description>
Description read_interface(Params& params) {
  Description model;
  model.int_ior = read_ior(params, "int_ior", model.int_ior);
  model.ext_ior = read_ior(params, "ext_ior", model.ext_ior);
  model.specular_reflectance = params.colour_map("specular_reflectance", RgbD(1.0), 0, 1);
  return model;
}

BsdfModel build_dielectric(Params& params) {
  auto dielectric = read_interface<DielectricDescription>(params);
  dielectric.specular_transmittance = params.colour_map("specular_transmittance", RgbD(1.0), 0, 1);
  if (params.has("priority")) dielectric.priority = static_cast<int>(params.integer("priority", 0, 0, 1'000'000));
  return dielectric;
}

BsdfModel build_thin_dielectric(Params& params) {
  auto pane = read_interface<ThinDielectricDescription>(params);
  pane.specular_transmittance = params.colour_map("specular_transmittance", RgbD(1.0), 0, 1);
  return pane;
}

BsdfModel build_plastic(Params& params) {
  auto plastic = read_interface<PlasticDescription>(params);
  plastic.diffuse_reflectance = params.colour_map("diffuse_reflectance", RgbD(0.5), 0, 1);
  plastic.nonlinear = params.boolean("nonlinear", false);
  return plastic;
}

BsdfModel build_phong(Params& params) {
  PhongDescription phong;
  phong.exponent = params.number_map("exponent", 30, 0, kUnbounded);
  phong.diffuse_reflectance = params.colour_map("diffuse_reflectance", RgbD(0.5), 0, 1);
  phong.specular_reflectance = params.colour_map("specular_reflectance", RgbD(0.2), 0, 1);
  return phong;
}

BsdfModel build_null(Params&) { return NullDescription{}; }

}  // namespace

std::vector<Plugin<BsdfModel>> leaf_bsdfs() {
  return {
      {"conductor",
       {{"material", ParamType::string}, {"eta", ParamType::colour}, {"k", ParamType::colour}, kReflectance},
       {},
       build_conductor},
      {"dielectric",
       {kIntIor, kExtIor, kReflectance, kTransmittance, {"priority", ParamType::integer}},
       {},
       build_dielectric},
      {"diffuse", {{"reflectance", ParamType::colour_map}}, {}, build_diffuse},
      {"null", {}, {}, build_null},
      {"phong",
       {{"exponent", ParamType::number_map}, {"diffuse_reflectance", ParamType::colour_map}, kReflectance},
       {},
       build_phong},
      {"plastic",
       {kIntIor,
        kExtIor,
        {"diffuse_reflectance", ParamType::colour_map},
        kReflectance,
        {"nonlinear", ParamType::boolean}},
       {},
       build_plastic},
      {"thindielectric", {kIntIor, kExtIor, kReflectance, kTransmittance}, {}, build_thin_dielectric},
  };
}

BsdfDescription read_bsdf(SceneObjects& objects, const Element& element) {
  static const std::vector<Plugin<BsdfModel>> table = merged(merged(leaf_bsdfs(), rough_bsdfs()), nesting_bsdfs());
  return {objects.sources().loc(element.at), id_of(element), build_plugin(objects, element, table)};
}

}  // namespace photonproof::scene_xml
