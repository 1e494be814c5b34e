// Common readers for the rows of benchmark suites and of gate suites.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/suites/suite.h"
#include "harness/suites/toml_table.h"
#include "scenes/base/edit_distance.h"

namespace photonproof::inline harness_suites {

inline constexpr std::size_t max_suite_bytes = std::size_t{1} << 24;
inline constexpr std::size_t max_scene_file_bytes = std::size_t{1} << 30;  // of an engine's own file of a scene
inline constexpr std::int64_t max_side = 1 << 14;  // 2^28 pixels, as scenes/images/image.h reads

/// "a, b, c", or "none".
template <class Items>
std::string names_of(const Items& items) {
  std::string names;
  for (const auto& item : items) names += (names.empty() ? "" : ", ") + item.name;
  return names.empty() ? "none" : names;
}

/// "unknown engine 'pth' (did you mean 'path'?); known: path, bdpt"
template <class Items>
std::string unknown_name(const std::string& what, const std::string& name, const Items& known) {
  std::vector<std::string> names;
  for (const auto& item : known) names.push_back(item.name);
  const std::string near = name.size() > 1 ? did_you_mean(name, names) : "";  // any name is near a single letter
  return "unknown " + what + " '" + name + "'" + near + "; known: " + names_of(known);
}

template <class Items>
auto* find_named(Items& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

/// The functions below throw InputError with the value's place.
int bounded_integer(const TomlTable& table, const std::string& key, std::int64_t least, std::int64_t most);

/// Letters, digits, '_', '.' and '-', so that it can name a file.
std::string file_name(const TomlTable& table, const std::string& key);

/// The error of a scene that cannot be parsed, with the key at its end that leaves the file to the engine.
InputError with_reader_advice(const InputError& error, const std::string& scene_name,
                              const std::filesystem::path& suite_file);

/// Throws InputError at `key` where our own integrators would have to render a scene that only an engine reads.
void expect_readable(const TomlTable& table, const std::string& key, const SuiteScene& scene, const Engine& engine);

/// The existing file that the key's path leads to from `folder`.
std::filesystem::path existing_file(const TomlTable& table, const std::string& key,
                                    const std::filesystem::path& folder);

/// The optional table [limits].
Limits limits_from_toml(const TomlTable& document);

/// The side of a scene's image, in pixels, where the suite does not state it and our program cannot read the scene.
inline constexpr int usual_side = 256;

/// Throws one InputError that names all keys that rows of the suite lack, if at least two are missing. `document` is
/// parsed for this alone, since the table records the keys that were asked for.
void expect_required_keys(const TomlTable& document);

/// Name, path, reader, files, size and exposure of a scene for `suite`. The suite knows its engines and has no scene of
/// that name yet. A size that is missing is that of the scene's film, or `usual_side`.
SuiteScene scene_row(const TomlTable& table, const SuiteCommon& suite);

/// The engine that the key "engine" names.
const Engine& known_engine(const TomlTable& table, const std::vector<Engine>& engines);

/// The rows that one of two keys names: scene = "a", scenes = ["a", "b"]. Each takes a name or an array of names. At
/// least one row, none twice.
template <class Items>
auto named_rows(const std::string& one, const std::string& many, const TomlTable& table, Items& items) {
  if (table.has(one) && table.has(many))
    throw table.error(many, "'" + many + "' beside '" + one + "': give one of them");
  const std::string& key = table.has(many) ? many : one;
  const bool is_array = table.is_array(key);
  const std::vector<std::string> names = is_array ? table.strings(key) : std::vector{table.string(key)};
  if (names.empty()) throw table.error(key, "'" + key + "' must not be empty");
  std::vector<decltype(find_named(items, std::string()))> rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto error = [&](const std::string& message) {
      return is_array ? table.error(key, i, message) : table.error(key, message);
    };
    auto* row = find_named(items, names[i]);
    if (row == nullptr) throw error(unknown_name(one, names[i], items));
    if (std::find(rows.begin(), rows.end(), row) != rows.end()) throw error("'" + names[i] + "' is named twice");
    rows.push_back(row);
  }
  return rows;
}

/// The problem with a budget for an engine, empty when there is none.
std::optional<std::string> budget_problem(const std::string& text, const Engine& engine);

}  // namespace photonproof::inline harness_suites
