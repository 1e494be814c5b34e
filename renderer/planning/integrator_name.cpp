#include "renderer/planning/integrator_name.h"

#include <iterator>
#include <utility>
#include <variant>

namespace photonproof {
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
