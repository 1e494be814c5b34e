#include "renderer/planning/integrator_name.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/base/edit_distance.h"
#include "scenes/base/input_error.h"
#include "scenes/description/plugin_name.h"

namespace photonproof::inline renderer_planning {
namespace {

using Method = decltype(IntegratorDescription::method);

/// In the order of the variant.
const std::vector<const char*>& method_names() {
  static const std::vector<const char*> names = plugin_names(Method());
  return names;
}

/// The alternative of that name with default parameters. Throws InputError where there is none.
template <std::size_t... Index>
Method method_named(const std::string& name, std::index_sequence<Index...>) {
  Method method;
  bool found = false;
  ((name == method_names()[Index] ? (method.emplace<Index>(), void(found = true)) : void()), ...);
  if (found) return method;
  const std::vector<std::string> known(method_names().begin(), method_names().end());
  throw InputError("--integrator",
                   "unknown integrator '" + name + "'" + did_you_mean(name, known) + ", expected " + join_or(known));
}

}  // namespace

std::string integrator_name(const IntegratorDescription& description) {
  return method_names()[description.method.index()];
}

IntegratorDescription with_integrator(const IntegratorDescription& description, const std::string& name) {
  if (integrator_name(description) == name) return description;
  Method method = method_named(name, std::make_index_sequence<std::variant_size_v<Method>>{});
  std::visit([&](PathLimits& limits) { limits = description.limits(); }, method);
  return {description.loc, method};
}

}  // namespace photonproof::inline renderer_planning
