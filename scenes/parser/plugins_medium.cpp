// Mitsuba 3's homogeneous medium with the phase functions isotropic and hg; defaults are its.
#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Model = decltype(MediumDescription::model);
using Phase = decltype(HomogeneousDescription::phase);

Phase build_isotropic(Params&) { return IsotropicDescription{}; }

Phase build_hg(Params& params) {
  HenyeyGreensteinDescription phase;
  phase.g = params.number("g", phase.g);
  params.expect(phase.g > -1 && phase.g < 1, "g",
                "is " + format_number(phase.g) + ", expected more than -1 and less than 1");
  return phase;
}

const std::vector<Plugin<Phase>>& phase_table() {
  static const std::vector<Plugin<Phase>> rows = {{"hg", {{"g", ParamType::number}}, {}, build_hg},
                                                  {"isotropic", {}, {}, build_isotropic}};
  return rows;
}

Model build_homogeneous(Params& params) {
  HomogeneousDescription medium;
  medium.sigma_t = params.colour("sigma_t", medium.sigma_t, 0, kUnbounded);
  medium.albedo = params.colour("albedo", medium.albedo, 0, 1);
  medium.scale = params.number_in("scale", medium.scale, 0, kUnbounded);
  if (!params.nested("phase").empty())
    medium.phase = build_plugin(params.objects(), params.objects().target(params.only_nested("phase")), phase_table());
  return medium;
}

const std::vector<Plugin<Model>>& table() {
  static const std::vector<Plugin<Model>> rows = {
      {"homogeneous",
       {{"sigma_t", ParamType::colour}, {"albedo", ParamType::colour}, {"scale", ParamType::number}},
       {{"phase"}},
       build_homogeneous}};
  return rows;
}

}  // namespace

MediumDescription read_medium(SceneObjects& objects, const Element& element) {
  return {objects.sources().loc(element.at), id_of(element), build_plugin(objects, element, table())};
}

}  // namespace photonproof::scene_xml
