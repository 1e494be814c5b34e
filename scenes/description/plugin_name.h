// Plugin names as scene files use them, taken from `describe` (description.h).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenes/description/param_type.h"

namespace photonproof::inline scenes_description {

/// Receives the plugin's name from a `describe`. It ignores integrators' parameters; another plugin's may need a line
/// here.
struct PluginName {
  const char* name = "";

  void plugin(const char* type, const char*) { name = type; }
  void boolean(const char*, bool, const char*) {}
  void integer(const char*, std::int64_t, std::int64_t, std::int64_t, const char*) {}
  void number(const char*, double, const scene_xml::Range&, const char*) {}
  void positive(const char*, double, const char*, double = 0, const char* = "") {}
  template <class Value>
  void choice(const char*, Value, std::initializer_list<scene_xml::Word<std::type_identity_t<Value>>>, const char*) {}
  void also(const char*, scene_xml::ParamType, const char*, const char*) {}
};

/// The plugin names of every kind of the variant, in its order.
template <class... Kinds>
std::vector<const char*> plugin_names(const std::variant<Kinds...>&) {
  const auto name_of = [](auto description) {
    PluginName asked;
    describe(asked, description);
    return asked.name;
  };
  return {name_of(Kinds{})...};
}

}  // namespace photonproof::inline scenes_description
