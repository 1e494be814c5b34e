// What the rows of benchmark suites and of gate suites have in common.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/suite.h"
#include "harness/toml_table.h"

namespace photonproof {

inline constexpr std::size_t max_suite_bytes = std::size_t{1} << 24;
inline constexpr std::int64_t max_side = 1 << 14;  // 2^28 pixels, as scenes/image.h reads

/// "a, b, c", or "none".
template <class Items>
std::string names_of(const Items& items) {
  std::string names;
  for (const auto& item : items) names += (names.empty() ? "" : ", ") + item.name;
  return names.empty() ? "none" : names;
}

template <class Items>
auto* find_named(Items& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

/// The functions below throw InputError with the value's place.
int bounded_integer(const TomlTable& table, const std::string& key, std::int64_t least, std::int64_t most);

/// Letters, digits, '_', '.' and '-': fit to name a file.
std::string file_name(const TomlTable& table, const std::string& key);

/// The optional table [limits].
Limits limits_from_toml(const TomlTable& document);

/// Name, path, size and exposure of a scene, whose name none of `others` has.
SuiteScene scene_row(const TomlTable& table, const std::filesystem::path& folder,
                     const std::vector<SuiteScene>& others);

/// The engine that "engine" names.
const Engine& known_engine(const TomlTable& table, const std::vector<Engine>& engines);

/// The problem with a budget for an engine, empty when there is none.
std::optional<std::string> budget_problem(const std::string& text, const Engine& engine);

}  // namespace photonproof
