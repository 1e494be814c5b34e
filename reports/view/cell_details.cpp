#include "reports/view/cell_details.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/view/metric_columns.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"
#include "scenes/base/shell_text.h"

namespace photonproof::reports::inline reports_view {
namespace {

void append(std::string& list, const std::string& item) { list += (list.empty() ? "" : ", ") + item; }

void add(std::vector<Detail>& details, const char* term, const std::string& text) {
  if (!text.empty()) details.push_back({term, {text}});
}

/// Counts are exact. An engine's counts that are not whole numbers (a radius) are rounded.
std::string count_text(double value) { return value == std::floor(value) ? grouped(value) : significant(value, 4); }

bool has_column(const std::string& metric) {
  return std::ranges::any_of(metric_columns(), [&](const MetricColumn& column) { return column.metric == metric; });
}

}  // namespace

std::vector<Detail> cell_details(const Result& result) {
  std::string phases, counts, metrics;
  for (const auto& [phase, seconds] : result.phases) append(phases, phase + " " + significant(seconds) + " s");
  for (const auto& [what, count] : result.counts) append(counts, what + " " + count_text(count));
  for (const MetricValue& value : result.metrics) {
    if (!has_column(value.name)) append(metrics, value.name + " " + format_metric(value.name, value.value));
  }
  std::vector<Detail> details;
  if (!result.skipped.empty()) details.push_back({"skipped", result.skipped});
  add(details, "phases", phases);
  add(details, "counts", counts);
  add(details, "metrics", metrics);
  add(details, "version", result.engine_version);
  add(details, "image", result.image);
  return details;
}

std::string compare_command(const SceneView& scene, const Result& result) {
  const std::string reference = reference_image(scene);
  if (reference.empty() || result.image.empty() || &result == scene.reference) return {};
  std::string command = fmt::format("photonproof compare {} {} --exposure {:g}", shell_word(reference),
                                    shell_word(result.image), scene.record.exposure);
  if (const auto& range = scene.record.hdr_exposures)
    command += fmt::format(" --hdr-flip --exposures {} {} {}", range->start, range->stop, range->count);
  return command;
}

std::string reason_text(const Result& result) {
  if (result.status == Status::ok) return {};
  return result.detail.empty() ? "The record gives no reason." : result.detail;
}

std::string caveats_text(const Result& result) {
  std::string text;
  for (const std::string& caveat : result.caveats) text += (text.empty() ? "" : "; ") + caveat;
  return text;
}

std::string state_text(const EngineOutcome& outcome) {
  const std::size_t total = outcome.cells.size();
  if (total == 0) return "not run";
  if (outcome.finished == total) return fmt::format("{} finished", total);
  const auto failed = [](const Result* cell) { return cell->status != Status::ok; };
  const Status first = (*std::ranges::find_if(outcome.cells, failed))->status;
  const bool alike =
      std::ranges::all_of(outcome.cells, [&](const Result* cell) { return !failed(cell) || cell->status == first; });
  return fmt::format("{} of {} {}", total - outcome.finished, total, alike ? to_string(first) : "not finished");
}

}  // namespace photonproof::reports::inline reports_view
