#include "harness/stress/soak/soak_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_stress_soak {
namespace {

using Json = nlohmann::ordered_json;

Json series_json(const SoakSeries& series) {
  Json json = {{"name", series.name},
               {"unit", series.unit},
               {"verdict", to_string(series.drift.verdict)},
               {"growth_a_render", series.drift.slope},
               {"bound_a_render", series.bound},
               {"warm_up_cycles", series.warm_up},
               {"mean", series.drift.mean_value}};
  if (std::isfinite(series.drift.interval.low))
    json["interval"] = {series.drift.interval.low, series.drift.interval.high};
  json["values"] = series.values;
  return json;
}

std::string amount(double value, const std::string& unit) {
  return unit == "bytes" ? fmt::format("{:+.0f} bytes", value) : fmt::format("{:+.3g} {}", value, unit);
}

std::string series_words(const SoakSeries& series) {
  std::string words = series.name + " " + to_string(series.drift.verdict);
  if (!std::isfinite(series.drift.interval.low)) return words + " (too few cycles)";
  return words + fmt::format(" ({} to {} a render)", amount(series.drift.interval.low, series.unit),
                             amount(series.drift.interval.high, series.unit));
}

}  // namespace

DriftVerdict SoakRecord::verdict() const {
  const auto any = [&](DriftVerdict verdict) {
    return std::any_of(series.begin(), series.end(),
                       [&](const SoakSeries& row) { return row.drift.verdict == verdict; });
  };
  if (!problems.empty() || any(DriftVerdict::grows)) return DriftVerdict::grows;
  return any(DriftVerdict::unclear) || series.empty() ? DriftVerdict::unclear : DriftVerdict::flat;
}

std::string soak_sentence(const SoakRecord& record) {
  const DriftVerdict verdict = record.verdict();
  std::string text = !record.problems.empty() ? "failed" : to_string(verdict);
  text += fmt::format(": {} renders by processes and {} within one, in {:.0f} s; ", record.by_processes,
                      record.within_one, record.seconds);
  text += record.problems.empty()
              ? "every image had the same bits each time"
              : fmt::format("{} problems, the first: {}", record.problems.size(), record.problems.front());
  for (const SoakSeries& series : record.series) text += "; " + series_words(series);
  return text;
}

void write_soak_record(const SoakRecord& record, const std::filesystem::path& file) {
  Json json = {
      {"schema_version", 1},
      {"created", record.created},
      {"program", record.program},
      {"checksum", record.checksum},
      {"command", record.command},
      {"host", record.host},
      {"verdict", to_string(record.verdict())},
      {"sentence", soak_sentence(record)},
      {"seconds", record.seconds},
      {"interrupted", record.interrupted},
      {"renders", {{"asked", record.asked}, {"by_processes", record.by_processes}, {"within_one", record.within_one}}},
      {"problems", record.problems},
      {"series", Json::array()},
      {"kinds", Json::array()}};
  for (const SoakSeries& series : record.series) json["series"].push_back(series_json(series));
  for (const SoakKind& kind : record.kinds) {
    Json row = {{"scene", kind.scene}, {"method", kind.method}};
    if (kind.refused.empty())
      row["checksum"] = kind.checksum;
    else
      row["refused"] = kind.refused;
    json["kinds"].push_back(row);
  }
  write_file_atomically(file, json_text(json) + "\n");
}

}  // namespace photonproof::inline harness_stress_soak
