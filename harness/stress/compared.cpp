#include "harness/stress/compared.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/cells/cells.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_stress {
namespace {

std::string names_of(const std::vector<KnownMetric>& known) {
  std::string names;
  for (const KnownMetric& metric : known) names += (names.empty() ? "" : ",") + metric.name;
  return names;
}

std::string text_of(const std::optional<double>& value) { return value ? fmt::format("{:.9g}", *value) : "undefined"; }

/// The difference from the known value, as a sentence; empty where there is none.
std::string difference(const KnownMetric& known, const nlohmann::ordered_json& printed) {
  std::optional<double> value;
  if (printed["value"].is_number()) value = printed["value"].get<double>();
  const auto is_equal = [&] { return std::abs(*value - *known.value) <= known.tolerance * std::abs(*known.value); };
  const bool is_right = value && known.value ? (known.is_limit ? *value <= *known.value : is_equal())
                                             : !value && !known.value && printed.contains("undefined");
  return is_right ? "" : fmt::format("{} is {}, should be {}", known.name, text_of(value), text_of(known.value));
}

}  // namespace

std::vector<KnownMetric> printed_metrics(const StressRunner& runner, const std::filesystem::path& reference,
                                         const std::filesystem::path& test, const std::vector<std::string>& names) {
  std::vector<KnownMetric> known;
  for (const std::string& name : names) known.push_back({name, {}});
  const ProcessOutcome outcome =
      runner.run({"compare", reference.string(), test.string(), "--json", "--metrics", names_of(known)});
  const auto json = nlohmann::ordered_json::parse(outcome.standard_output, nullptr, false);
  if (json.is_discarded() || !json.contains("metrics")) throw InputError("compare", last_line(outcome.standard_error));
  for (KnownMetric& metric : known)
    for (const auto& printed : json["metrics"])
      if (printed["name"] == metric.name && printed["value"].is_number()) metric.value = printed["value"].get<double>();
  return known;
}

LevelVerdict compare_files(const StressRunner& runner, const std::filesystem::path& reference,
                           const std::filesystem::path& test, const std::vector<KnownMetric>& known,
                           const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"compare", reference.string(), test.string(), "--json", "--metrics", names_of(known)};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const ProcessOutcome outcome = runner.run(all);
  if (outcome.end != ProcessOutcome::End::exited) return {LevelOutcome::crashed, outcome.sentence(), {}};
  const auto json = nlohmann::ordered_json::parse(outcome.standard_output, nullptr, false);
  if (outcome.exit_code != 0) {
    std::string why = last_line(outcome.standard_error);
    if (!json.is_discarded() && json.contains("findings") && !json["findings"].empty())
      why = json["findings"][0].dump();
    return {why.empty() ? LevelOutcome::crashed : LevelOutcome::refused, why.empty() ? outcome.sentence() : why, {}};
  }
  if (json.is_discarded() || !json.contains("metrics"))
    return {LevelOutcome::crashed, "the output of compare is not JSON", {}};
  std::string wrong;
  std::size_t found = 0;
  for (const KnownMetric& metric : known)
    for (const auto& printed : json["metrics"]) {
      if (printed["name"] != metric.name) continue;
      ++found;
      if (const std::string text = difference(metric, printed); !text.empty() && wrong.empty()) wrong = text;
    }
  if (found < known.size()) wrong = "a metric is missing";
  return {wrong.empty() ? LevelOutcome::right : LevelOutcome::silently_wrong, wrong, {}};
}

}  // namespace photonproof::inline harness_stress
