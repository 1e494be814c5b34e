// Mitsuba 3's BSDFs with a microfacet distribution; defaults are its.
#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {
namespace {

template <class Description>
void read_distribution(Params& params, Description& model) {
  const std::string name = params.string("distribution", "beckmann");
  params.expect(name == "beckmann" || name == "ggx", "distribution",
                "is " + in_quotes(name) + ", expected beckmann or ggx");
  model.distribution = name == "ggx" ? MicrofacetDistribution::ggx : MicrofacetDistribution::beckmann;
  model.sample_visible = params.boolean("sample_visible", true);
}

/// A number must be above 0; the texels of a texture may be 0.
Scalar read_roughness(Params& params, const std::string& name) {
  const Scalar alpha = params.number_map(name, 0.1, 0, kUnbounded);
  if (std::holds_alternative<double>(alpha)) params.positive(name, 0.1);
  return alpha;
}

template <class Description>
void read_alphas(Params& params, Description& model) {
  if (!params.has("alpha_u") && !params.has("alpha_v")) {
    model.alpha_u = model.alpha_v = read_roughness(params, "alpha");
    return;
  }
  params.expect(!params.has("alpha"), "alpha", "is given beside alpha_u and alpha_v, expected one or the other");
  for (const char* name : {"alpha_u", "alpha_v"})
    params.expect(params.has(name), name, "is missing: alpha_u and alpha_v go together");
  model.alpha_u = read_roughness(params, "alpha_u");
  model.alpha_v = read_roughness(params, "alpha_v");
}

BsdfModel build_rough_conductor(Params& params) {
  RoughConductorDescription model;
  read_distribution(params, model);
  read_alphas(params, model);
  model.ior = read_conductor_ior(params);
  model.specular_reflectance = params.colour_map("specular_reflectance", RgbD(1.0), 0, 1);
  return model;
}

BsdfModel build_rough_dielectric(Params& params) {
  RoughDielectricDescription model;
  read_distribution(params, model);
  read_alphas(params, model);
  model.int_ior = read_ior(params, "int_ior", model.int_ior);
  model.ext_ior = read_ior(params, "ext_ior", model.ext_ior);
  model.specular_reflectance = params.colour_map("specular_reflectance", RgbD(1.0), 0, 1);
  model.specular_transmittance = params.colour_map("specular_transmittance", RgbD(1.0), 0, 1);
  return model;
}

BsdfModel build_rough_plastic(Params& params) {
  RoughPlasticDescription model;
  read_distribution(params, model);
  model.alpha = params.positive("alpha", model.alpha);
  model.int_ior = read_ior(params, "int_ior", model.int_ior);
  model.ext_ior = read_ior(params, "ext_ior", model.ext_ior);
  model.diffuse_reflectance = params.colour_map("diffuse_reflectance", RgbD(0.5), 0, 1);
  model.specular_reflectance = params.colour_map("specular_reflectance", RgbD(1.0), 0, 1);
  model.nonlinear = params.boolean("nonlinear", false);
  return model;
}

std::vector<ParamSpec> with_distribution(std::vector<ParamSpec> own) {
  own.insert(own.begin(), {{"distribution", ParamType::string}, {"sample_visible", ParamType::boolean}});
  own.push_back({"specular_reflectance", ParamType::colour_map});
  return own;
}

}  // namespace

std::vector<Plugin<BsdfModel>> rough_bsdfs() {
  const ParamSpec alpha{"alpha", ParamType::number_map}, alpha_u{"alpha_u", ParamType::number_map},
      alpha_v{"alpha_v", ParamType::number_map}, int_ior{"int_ior", ParamType::ior}, ext_ior{"ext_ior", ParamType::ior};
  return {
      {"roughconductor",
       with_distribution({alpha,
                          alpha_u,
                          alpha_v,
                          {"material", ParamType::string},
                          {"eta", ParamType::colour},
                          {"k", ParamType::colour}}),
       {},
       build_rough_conductor},
      {"roughdielectric",
       with_distribution(
           {alpha, alpha_u, alpha_v, int_ior, ext_ior, {"specular_transmittance", ParamType::colour_map}}),
       {},
       build_rough_dielectric},
      {"roughplastic",
       with_distribution({{"alpha", ParamType::number},
                          int_ior,
                          ext_ior,
                          {"diffuse_reflectance", ParamType::colour_map},
                          {"nonlinear", ParamType::boolean}}),
       {},
       build_rough_plastic},
  };
}

}  // namespace photonproof::scene_xml
