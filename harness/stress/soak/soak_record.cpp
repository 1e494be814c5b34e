#include "harness/stress/soak/soak_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/stress/soak/soak_fields.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/records/record_writer.h"

namespace photonproof::inline harness_stress_soak {
namespace {

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
  write_file_atomically(file, json_text(record_json(record)) + "\n");
}

}  // namespace photonproof::inline harness_stress_soak
