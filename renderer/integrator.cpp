#include "renderer/integrator.h"

#include "renderer/bdpt.h"
#include "renderer/direct_integrator.h"
#include "renderer/particle_tracer.h"
#include "renderer/path_integrator.h"
#include "renderer/photon_mapper.h"
#include "renderer/volpath.h"
#include "renderer/whitted.h"

namespace photonproof {

const std::vector<Integrator>& integrators() {
  static const std::vector<Integrator> table{
      {"path",
       "unbiased path tracing: next-event estimation, MIS, Russian roulette",
       render_path,
       {.target_error = true}},
      {"photonmapper",
       "global and caustic photon maps of fixed radius, direct light by next-event estimation",
       render_photon_mapper,
       {.photons = true}},
      {"direct", "emission and light reflected once: next-event estimation and BSDF sampling, MIS", render_direct},
      {"bdpt",
       "unbiased bidirectional path tracing: every way of making a path, weighted against the others",
       render_bdpt,
       {.isa = false},
       Integrator::Media::absorbing,
       true},
      {"ptracer",
       "unbiased light tracing: paths from the lights, every vertex connected to the camera",
       render_particle_tracer,
       {.grid = false, .isa = false},
       Integrator::Media::absorbing,
       true},
      {"volpath",
       "unbiased path tracing through participating media and nested dielectrics",
       render_volpath,
       {.isa = false, .target_error = true},
       Integrator::Media::all,
       true},
      {"whitted",
       "mirrors and glass followed exactly, direct light elsewhere, no interreflection",
       render_whitted,
       {.isa = false, .target_error = true}},
  };
  return table;
}

const Integrator* find_integrator(const std::string& name) {
  for (const Integrator& row : integrators())
    if (name == row.name) return &row;
  return nullptr;
}

namespace {

using Method = decltype(IntegratorDescription::method);

/// The scene file's name of each description, in the order of the variant.
constexpr const char* method_names[] = {"path", "photonmapper", "volpath", "bdpt", "ptracer", "direct", "whitted"};
static_assert(std::size(method_names) == std::variant_size_v<Method>);

/// The alternative of that name with default parameters.
template <std::size_t... Index>
Method method_named(const std::string& name, std::index_sequence<Index...>) {
  Method method;
  ((name == method_names[Index] ? void(method.emplace<Index>()) : void()), ...);
  return method;
}

}  // namespace

std::string integrator_name(const IntegratorDescription& description) {
  return method_names[description.method.index()];
}

IntegratorDescription with_integrator(const IntegratorDescription& description, const std::string& name) {
  if (integrator_name(description) == name) return description;
  Method method = method_named(name, std::make_index_sequence<std::variant_size_v<Method>>{});
  std::visit([&](PathLimits& limits) { limits = description.limits(); }, method);
  return {description.loc, method};
}

}  // namespace photonproof
