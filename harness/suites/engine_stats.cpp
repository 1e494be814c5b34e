#include "harness/suites/engine_stats.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_suites {
namespace {

using nlohmann::json;

constexpr std::size_t max_bytes = std::size_t{1} << 24;

void read_numbers(const json& stats, const char* key, bool may_be_negative, std::map<std::string, double>& numbers,
                  std::optional<std::string>& problem) {
  const auto found = stats.find(key);
  if (found == stats.end()) return;
  if (!found->is_object()) {
    problem = "'" + std::string(key) + "' is not an object";
    return;
  }
  for (const auto& [name, value] : found->items()) {
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (std::isfinite(number) && (may_be_negative || number >= 0))
      numbers[printable(name)] = number;
    else
      problem = "'" + std::string(key) + "' has no usable number for '" + printable(name) + "'";
  }
}

void read_texts(const json& stats, const char* key, std::vector<std::string>& texts,
                std::optional<std::string>& problem) {
  const auto found = stats.find(key);
  if (found == stats.end()) return;
  if (!found->is_array()) {
    problem = "'" + std::string(key) + "' is not an array";
    return;
  }
  for (const json& entry : *found) {
    if (entry.is_string())
      texts.push_back(printable(entry.get<std::string>()));
    else
      problem = "'" + std::string(key) + "' holds something that is not a string";
  }
}

/// Null, as without the key: the image is not denoised.
void read_denoised(const json& stats, EngineStats& out) {
  const auto found = stats.find("denoised");
  if (found == stats.end() || found->is_null()) return;
  const auto text = [&](const char* key) {
    const json value = found->is_object() ? found->value(key, json()) : json();
    return value.is_string() ? printable(value.get<std::string>()) : std::string();
  };
  out.denoised = text("library") + " " + text("version");
  if (text("library").empty()) out.problem = "'denoised' names no library";
}

}  // namespace

EngineStats read_engine_stats(const std::filesystem::path& file) {
  EngineStats out;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return out;
  try {
    const json stats = json::parse(read_file(file, max_bytes));
    if (!stats.is_object() || stats.value("schema_version", json()) != 1) {
      out.problem = "it lacks \"schema_version\": 1";
      return out;
    }
    read_numbers(stats, "phases", false, out.phases, out.problem);
    read_numbers(stats, "counts", true, out.counts, out.problem);
    read_texts(stats, "skipped", out.skipped, out.problem);
    read_texts(stats, "losses", out.losses, out.problem);
    read_texts(stats, "cannot_find", out.cannot_find, out.problem);
    read_denoised(stats, out);
  } catch (const json::exception&) {
    out.problem = "it is not valid JSON";
  } catch (const InputError& unreadable) {
    out.problem = unreadable.summary();
  }
  return out;
}

}  // namespace photonproof::inline harness_suites
