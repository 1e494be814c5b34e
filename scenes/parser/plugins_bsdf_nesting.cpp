// BSDFs around other BSDFs: Mitsuba 3's twosided, mask, blendbsdf, bumpmap and normalmap, and the extension layered;
// defaults are Mitsuba's.
#include <type_traits>

#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {
namespace {

BsdfIndex nested(Params& params, std::size_t i) { return params.objects().bsdf(*params.nested("bsdf")[i]); }

BsdfIndex only_bsdf(Params& params) { return params.objects().bsdf(params.only_nested("bsdf")); }

/// Whether it nests no others.
bool is_plain(const BsdfModel& model) {
  return std::visit(
      []<class Model>(const Model&) { return LeafBsdf<Model> && !std::is_same_v<Model, LayeredDescription>; }, model);
}

BsdfIndex expect_opaque(Params& params, BsdfIndex index, std::size_t child) {
  if (params.objects().transmits(index))
    params.sources().fail(params.nested("bsdf")[child]->at,
                          params.title() + " nests a BSDF that lets light through, expected one that reflects only");
  return index;
}

BsdfModel build_two_sided(Params& params) {
  params.only_nested("bsdf");
  TwoSidedDescription model;
  model.front = expect_opaque(params, nested(params, 0), 0);
  model.back = params.nested("bsdf").size() == 2 ? expect_opaque(params, nested(params, 1), 1) : model.front;
  return model;
}

BsdfModel build_mask(Params& params) {
  MaskDescription model;
  model.opacity = params.number_map("opacity", 0.5, 0, 1);
  model.nested = only_bsdf(params);
  return model;
}

BsdfModel build_blend(Params& params) {
  BlendDescription model;
  params.expect(params.has("weight"), "weight", "is missing, expected a number or a texture");
  model.weight = params.number_map("weight", 0.5, 0, 1);
  const std::size_t count = params.nested("bsdf").size();
  if (count != 2)
    params.sources().fail(params.object().at,
                          params.title() + " has " + std::to_string(count) + " of <bsdf>, expected two");
  model.first = nested(params, 0);
  model.second = nested(params, 1);
  return model;
}

MappedNormalsDescription mapped_normals(Params& params) {
  MappedNormalsDescription options;
  options.flip_invalid_normals = params.boolean("flip_invalid_normals", options.flip_invalid_normals);
  options.use_shadowing_function = params.boolean("use_shadowing_function", options.use_shadowing_function);
  return options;
}

BsdfModel build_bump_map(Params& params) {
  BumpMapDescription model;
  model.height = params.objects().texture(params.only_nested("texture"));
  model.scale = params.number("scale", model.scale);
  model.normal_options = mapped_normals(params);
  model.nested = only_bsdf(params);
  return model;
}

BsdfModel build_normal_map(Params& params) {
  NormalMapDescription model;
  params.expect(params.has("normalmap"), "normalmap", "is missing, expected a texture");
  model.normals = *params.texture("normalmap");
  model.normal_options = mapped_normals(params);
  model.nested = only_bsdf(params);
  return model;
}

BsdfModel build_layered(Params& params) {
  LayeredDescription model;
  model.int_ior = read_ior(params, "int_ior", model.int_ior);
  model.ext_ior = read_ior(params, "ext_ior", model.ext_ior);
  model.sigma_a = params.colour("sigma_a", model.sigma_a, 0, kUnbounded);
  model.thickness = params.number_in("thickness", model.thickness, 0, kUnbounded);
  model.specular_reflectance = params.colour_map("specular_reflectance", RgbD(1.0), 0, 1);
  model.base = expect_opaque(params, only_bsdf(params), 0);
  if (!is_plain(params.objects().scene().bsdfs[model.base.value].model))
    params.sources().fail(params.nested("bsdf")[0]->at,
                          params.title() + " has a base that nests other BSDFs, expected a plain one");
  return model;
}

}  // namespace

std::vector<Plugin<BsdfModel>> nesting_bsdfs() {
  return {
      {"blendbsdf", {{"weight", ParamType::number_map}}, {{"bsdf", 2}}, build_blend},
      {"bumpmap",
       {{"scale", ParamType::number},
        {"flip_invalid_normals", ParamType::boolean},
        {"use_shadowing_function", ParamType::boolean}},
       {{"bsdf"}, {"texture"}},
       build_bump_map},
      {"layered",
       {{"int_ior", ParamType::ior},
        {"ext_ior", ParamType::ior},
        {"sigma_a", ParamType::colour},
        {"thickness", ParamType::number},
        {"specular_reflectance", ParamType::colour_map}},
       {{"bsdf"}},
       build_layered},
      {"mask", {{"opacity", ParamType::number_map}}, {{"bsdf"}}, build_mask},
      {"normalmap",
       {{"normalmap", ParamType::texture},
        {"flip_invalid_normals", ParamType::boolean},
        {"use_shadowing_function", ParamType::boolean}},
       {{"bsdf"}},
       build_normal_map},
      {"twosided", {}, {{"bsdf", 2}}, build_two_sided},
  };
}

}  // namespace photonproof::scene_xml
