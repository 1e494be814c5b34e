#include "renderer/integrator.h"

#include "renderer/path_integrator.h"
#include "renderer/photon_mapper.h"

namespace photonproof {

const std::vector<Integrator>& integrators() {
  static const std::vector<Integrator> table{
      {"path", "unbiased path tracing: next-event estimation, MIS, Russian roulette", render_path},
      {"photonmapper", "global and caustic photon maps of fixed radius, direct light by next-event estimation",
       render_photon_mapper},
  };
  return table;
}

const Integrator* find_integrator(const std::string& name) {
  for (const Integrator& row : integrators())
    if (name == row.name) return &row;
  return nullptr;
}

std::string integrator_name(const IntegratorDescription& description) {
  constexpr const char* names[] = {"path", "photonmapper", "volpath", "bdpt", "ptracer", "direct", "whitted"};
  static_assert(std::size(names) == std::variant_size_v<decltype(IntegratorDescription::method)>);
  return names[description.method.index()];
}

IntegratorDescription with_integrator(const IntegratorDescription& description, const std::string& name) {
  if (integrator_name(description) == name) return description;
  const auto carry_over = [&](auto method) {
    std::visit(
        [&](const auto& asked) {
          method.max_depth = asked.max_depth;
          method.rr_depth = asked.rr_depth;
          method.hide_emitters = asked.hide_emitters;
        },
        description.method);
    return IntegratorDescription{description.loc, method};
  };
  return name == "path" ? carry_over(PathDescription{}) : carry_over(PhotonMapperDescription{});
}

}  // namespace photonproof
