#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "reports/history/history_comparison.h"
#include "reports/history/history_words.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"

namespace photonproof::reports::inline reports_history {
namespace {

// GitHub refuses comments of more than 65,536 characters.
constexpr std::size_t most_rows = 60;

std::string plural(std::size_t count, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string cell_text(const SeriesKey& key) {
  std::string text = key.scene + " " + key.size + ", " + key.engine;
  if (key.measure != Measure::gate) text += ", " + key.budget;
  return markdown_text(text);
}

std::string changes_table(const HistoryComparison& comparison) {
  if (comparison.changes.empty()) return "";
  std::string out = "| | quantity | scene, engine, budget | base | head | change |\n|---|---|---|--:|--:|---|\n";
  for (std::size_t i = 0; i < std::min(most_rows, comparison.changes.size()); ++i) {
    const HistoryChange& change = comparison.changes[i];
    out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", change.side == ChangeSide::worse ? "**worse**" : "better",
                       markdown_text(measure_text(change.key)), cell_text(change.key),
                       value_text(change.key, change.step.before), value_text(change.key, change.step.after),
                       change_text(change.key, change.step));
  }
  if (comparison.changes.size() > most_rows)
    out += fmt::format("\n{} more are on the page of `photonproof history show`.\n",
                       comparison.changes.size() - most_rows);
  return out + "\n";
}

std::string verdict_text(const std::optional<GateVerdict>& verdict) {
  return verdict ? to_string(*verdict) : undefined_number;
}

std::string gates_table(const HistoryComparison& comparison) {
  if (comparison.gates.empty()) return "";
  std::string out = "| gate | scene, engine | base | head |\n|---|---|---|---|\n";
  for (std::size_t i = 0; i < std::min(most_rows, comparison.gates.size()); ++i) {
    const GateChange& gate = comparison.gates[i];
    out += fmt::format("| {} | {} | {} | {} |\n", markdown_text(gate.key.budget), cell_text(gate.key),
                       verdict_text(gate.base), verdict_text(gate.head));
  }
  return out + "\n";
}

std::string picture_cell(const std::string& url, const std::string& file, const char* what) {
  return file.empty() ? undefined_number
                      : fmt::format("<img src=\"{}\" alt=\"{}\" width=\"256\">", url + url_path(file), what);
}

std::string pictures_table(const HistoryComparison& comparison, const std::string& url) {
  if (comparison.pictures.empty()) return "";
  std::string out =
      fmt::format("<details{}><summary>{} of {} changed</summary>\n\n", comparison.changes.empty() ? "" : " open",
                  comparison.pictures_changed, plural(comparison.pictures_compared, "picture", "pictures"));
  out += "| | old | new | difference |\n|---|---|---|---|\n";
  for (const PictureChange& picture : comparison.pictures)
    out += fmt::format("| {}<br>{} | {} | {} | {} |\n",
                       markdown_text(picture.scene + ", " + picture.engine + ", " + picture.budget),
                       picture.problem.empty() ? "FLIP " + significant(picture.flip) : markdown_text(picture.problem),
                       picture_cell(url, picture.old_file, "old"), picture_cell(url, picture.new_file, "new"),
                       picture_cell(url, picture.difference_file, "difference"));
  return out + "\n</details>\n\n";
}

std::string note(const HistoryComparison& comparison) {
  std::string out = plural(comparison.compared, "series", "series") + " compared";
  if (comparison.undecided > 0)
    out += fmt::format(", {} undecided: their noise needs three commits before the head", comparison.undecided);
  if (comparison.only_head > 0) out += fmt::format(", {} new", comparison.only_head);
  if (comparison.only_base > 0) out += fmt::format(", {} missing at the head", comparison.only_base);
  return out + ".";
}

}  // namespace

bool is_worse(const HistoryComparison& comparison) {
  return std::ranges::any_of(comparison.changes, [](const auto& change) { return change.side == ChangeSide::worse; }) ||
         std::ranges::any_of(comparison.gates, [](const GateChange& gate) {
           return gate.head == GateVerdict::fail && gate.base != GateVerdict::fail;
         });
}

std::string comparison_sentence(const HistoryComparison& comparison) {
  const auto failing = static_cast<std::size_t>(
      std::ranges::count_if(comparison.gates, [](const GateChange& gate) { return gate.head == GateVerdict::fail; }));
  const std::string gates = failing == 0 ? "" : "; " + plural(failing, "gate fails", "gates fail");
  if (comparison.changes.empty()) {
    if (comparison.compared == 0) return "Nothing can be compared yet" + gates;
    return fmt::format("No change beyond noise in {} series{}", comparison.compared, gates);
  }
  const HistoryChange& first = comparison.changes.front();
  const std::size_t others = comparison.changes.size() - 1;
  return fmt::format("{} {}{}{}", subject_text(first.key), change_text(first.key, first.step),
                     others == 0 ? "" : fmt::format(", and {} more changed", others), gates);
}

std::string comparison_markdown(const HistoryComparison& comparison, const std::string& picture_url) {
  std::string out = fmt::format(
      "### photonproof: {}\n\n{} compared with {}. {}\n\n{}{}{}", markdown_text(comparison_sentence(comparison)),
      markdown_text(commit_text(comparison.head.name)), markdown_text(commit_text(comparison.base.name)),
      note(comparison), changes_table(comparison), gates_table(comparison), pictures_table(comparison, picture_url));
  out.pop_back();  // each part ends with an empty line
  return out;
}

}  // namespace photonproof::reports::inline reports_history
