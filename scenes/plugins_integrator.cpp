// Mitsuba 3's path integrator, and photonmapper: our own name and parameters, since Mitsuba 3 has none.
#include "scenes/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Method = decltype(IntegratorDescription::method);

constexpr std::int64_t kMaxDepth = 1'000'000;
constexpr std::int64_t kMaxPhotons = std::int64_t{1} << 40;

/// What both methods share.
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

Method build_path(Params& params) { return read_common<PathDescription>(params); }

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

std::vector<ParamSpec> with_common(std::vector<ParamSpec> own) {
  own.insert(
      own.begin(),
      {{"max_depth", ParamType::integer}, {"rr_depth", ParamType::integer}, {"hide_emitters", ParamType::boolean}});
  return own;
}

const std::vector<Plugin<Method>>& table() {
  static const std::vector<Plugin<Method>> rows = {
      {"path", with_common({}), {}, build_path},
      {"photonmapper",
       with_common({{"global_photons", ParamType::integer},
                    {"caustic_photons", ParamType::integer},
                    {"global_radius", ParamType::number},
                    {"caustic_radius", ParamType::number}}),
       {},
       build_photon_mapper},
  };
  return rows;
}

}  // namespace

IntegratorDescription read_integrator(const Sources& sources, const Element& element) {
  return {sources.loc(element.at), build_plugin(sources, element, table())};
}

}  // namespace photonproof::scene_xml
