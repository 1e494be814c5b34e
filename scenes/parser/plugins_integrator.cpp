// Mitsuba 3's integrators path, volpath, ptracer, direct and moment, and the extensions bdpt, whitted and photonmapper.
#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Method = decltype(IntegratorDescription::method);

constexpr std::int64_t kMaxDepth = 1'000'000;
constexpr std::int64_t kMaxPhotons = std::int64_t{1} << 40;

/// What all methods but direct share.
template <class Description>
Description read_common(Params& params) {
  Description method;
  method.max_depth = static_cast<int>(params.integer("max_depth", method.max_depth, -1, kMaxDepth));
  params.expect(method.max_depth != 0, "max_depth",
                "is 0, which renders black, expected -1 (unlimited) or at least 1 (emitters only)");
  method.rr_depth = static_cast<int>(params.integer("rr_depth", method.rr_depth, 1, kMaxDepth));
  method.hide_emitters = params.boolean("hide_emitters", method.hide_emitters);
  return method;
}

template <class Description>
Method build_common(Params& params) {
  return read_common<Description>(params);
}

Method build_direct(Params& params) {
  DirectDescription method;
  method.hide_emitters = params.boolean("hide_emitters", method.hide_emitters);
  constexpr std::int64_t kMost = 1 << 16;
  const bool each = params.has("emitter_samples") || params.has("bsdf_samples");
  params.expect(!(each && params.has("shading_samples")), "shading_samples",
                "is given beside emitter_samples or bsdf_samples, expected one or the other");
  const std::int64_t both = params.integer("shading_samples", 1, 1, kMost);
  method.emitter_samples = static_cast<int>(params.integer("emitter_samples", both, 0, kMost));
  method.bsdf_samples = static_cast<int>(params.integer("bsdf_samples", both, 0, kMost));
  params.expect(method.emitter_samples + method.bsdf_samples > 0, "emitter_samples",
                "and bsdf_samples are both 0, expected at least one sample");
  return method;
}

Method build_photon_mapper(Params& params) {
  auto method = read_common<PhotonMapperDescription>(params);
  method.global_photons = params.integer("global_photons", method.global_photons, 0, kMaxPhotons);
  method.caustic_photons = params.integer("caustic_photons", method.caustic_photons, 0, kMaxPhotons);
  method.global_radius = params.number("global_radius", method.global_radius);
  method.caustic_radius = params.number("caustic_radius", method.caustic_radius);
  const std::string expected = ", expected a positive length, or 0 for the automatic choice";
  params.expect(method.global_radius >= 0, "global_radius", "is " + format_number(method.global_radius) + expected);
  params.expect(method.caustic_radius >= 0, "caustic_radius", "is " + format_number(method.caustic_radius) + expected);
  return method;
}

/// Mitsuba's wrapper that adds the variance of every pixel, which is always written here.
Method build_moment(Params& params) {
  const Element& nested = params.only_nested("integrator");
  if (nested.tag == "ref") params.sources().fail(nested.at, "<ref> to an integrator, expected the integrator itself");
  return read_integrator(params.objects(), nested).method;
}

std::vector<ParamSpec> with_common(std::vector<ParamSpec> own) {
  own.insert(
      own.begin(),
      {{"max_depth", ParamType::integer}, {"rr_depth", ParamType::integer}, {"hide_emitters", ParamType::boolean}});
  return own;
}

const std::vector<Plugin<Method>>& table() {
  static const std::vector<Plugin<Method>> rows = {
      {"bdpt", with_common({}), {}, build_common<BdptDescription>},
      {"direct",
       {{"shading_samples", ParamType::integer},
        {"emitter_samples", ParamType::integer},
        {"bsdf_samples", ParamType::integer},
        {"hide_emitters", ParamType::boolean}},
       {},
       build_direct},
      {"moment", {}, {{"integrator"}}, build_moment},
      {"path", with_common({}), {}, build_common<PathDescription>},
      {"photonmapper",
       with_common({{"global_photons", ParamType::integer},
                    {"caustic_photons", ParamType::integer},
                    {"global_radius", ParamType::number},
                    {"caustic_radius", ParamType::number}}),
       {},
       build_photon_mapper},
      {"ptracer", with_common({}), {}, build_common<ParticleTracerDescription>},
      {"volpath", with_common({}), {}, build_common<VolPathDescription>},
      {"whitted", with_common({}), {}, build_common<WhittedDescription>},
  };
  return rows;
}

}  // namespace

IntegratorDescription read_integrator(SceneObjects& objects, const Element& element) {
  if (const Attribute* type = element.find("type"); type && (type->value == "sppm" || type->value == "vcm"))
    fail_at(objects.sources(), *type,
            "integrator " + in_quotes(type->value) +
                " is not built yet, expected bdpt or photonmapper, which see the "
                "same light");
  return {objects.sources().loc(element.at), build_plugin(objects, element, table())};
}

}  // namespace photonproof::scene_xml
