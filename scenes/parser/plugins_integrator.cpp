// Mitsuba 3's integrators path, volpath, ptracer, direct and moment, and the extensions bdpt, whitted, photonmapper and
// sppm.
#include "scenes/description/description.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {
namespace {

using Method = decltype(IntegratorDescription::method);

struct CompleteIntegrator {
  Params& params;

  /// All integrators except direct.
  void operator()(PathLimits&) const {}
  void operator()(DirectDescription& d) const {
    const bool each = params.has("emitter_samples") || params.has("bsdf_samples");
    params.expect(!(each && params.has("shading_samples")), "shading_samples",
                  "is given beside emitter_samples or bsdf_samples, expected one or the other");
    if (params.has("shading_samples"))
      d.emitter_samples = d.bsdf_samples = static_cast<int>(params.integer("shading_samples", 1, 1, 1 << 16));
    params.expect(d.emitter_samples + d.bsdf_samples > 0, "emitter_samples",
                  "and bsdf_samples are both 0, expected at least one sample");
  }
};

Method build_moment(Params& params) {
  return read_integrator(params.objects(), params.objects().target(params.only_nested("integrator"))).method;
}

std::vector<Plugin<Method>> integrator_plugins() {
  std::vector<Plugin<Method>> rows = described_plugins<Method, CompleteIntegrator>();
  rows.push_back(plugin_of<Method>(MomentPlugin{}, build_moment));
  sort_by_name(rows);
  return rows;
}

}  // namespace

IntegratorDescription read_integrator(SceneObjects& objects, const Element& element) {
  if (const Attribute* type = element.find("type"); type && type->value == "vcm")
    fail_at(objects.sources(), *type,
            "integrator " + in_quotes(type->value) +
                " is not built yet, expected bdpt or photonmapper, which see the "
                "same light");
  static const std::vector<Plugin<Method>> table = integrator_plugins();
  return {objects.sources().loc(element.at), build_plugin(objects, element, table)};
}

}  // namespace photonproof::scene_xml
