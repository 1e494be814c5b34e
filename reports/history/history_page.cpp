#include "reports/history/history_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "reports/history/history_plot.h"
#include "reports/history/history_templates.h"
#include "reports/history/history_words.h"
#include "reports/page/page_parts.h"
#include "reports/page/templates.h"
#include "reports/view/text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::reports::inline reports_history {
namespace {

using kainjow::mustache::data;

constexpr std::size_t most_steps = 200;
// Markers of a whole page: more would make it slow to open.
constexpr std::size_t markers_of_page = 12'000;

data steps_data(const History& history, const std::vector<NamedStep>& steps) {
  data rows(data::type::list);
  for (std::size_t i = 0; i < std::min(steps.size(), most_steps); ++i) {
    const auto& [series, step] = steps[i];
    const HistoryCommit& commit = history.commits[series->points[step->point].commit];
    const bool worse = is_worse(series->key, *step);
    data row;
    row.set("commit", printable(commit_text(commit.name)));
    row.set("date", date_text(commit.date));
    row.set("quantity", printable(measure_text(series->key)));
    row.set("cell", printable(series->key.scene + " " + series->key.size + ", " + series->key.engine +
                              (series->key.measure == Measure::gate ? "" : ", " + series->key.budget)));
    row.set("change", printable(change_text(series->key, *step)));
    row.set("values", printable(value_text(series->key, step->before) + " → " + value_text(series->key, step->after)));
    row.set("class", worse ? "poor" : "good");
    row.set("side", worse ? "worse" : "better");
    rows.push_back(row);
  }
  return rows;
}

/// Without the calibration's workload, which only tells series apart.
std::string machine_text(const SeriesKey& key) { return key.machine.substr(0, key.machine.find(", calibration ")); }

std::set<std::string> machines_of(const History& history) {
  std::set<std::string> machines;
  for (const HistorySeries& series : history.series)
    if (!series.key.machine.empty()) machines.insert(machine_text(series.key));
  return machines;
}

/// The machine is named where the history has several.
std::string remark_on(const HistorySeries& series, bool names_machine) {
  std::string remark = fmt::format("{} commit{}", series.points.size(), series.points.size() == 1 ? "" : "s");
  if (series.is_calibrated) remark += ", by calibration";
  if (!series.is_judged) remark += ", not judged: it follows the load";
  if (names_machine && !series.key.machine.empty()) remark += "; " + machine_text(series.key);
  return remark;
}

data plot_data(const History& history, const HistorySeries& series, std::size_t markers, bool names_machine) {
  data plot;
  plot.set("quantity", printable(measure_text(series.key)));
  plot.set("value", value_text(series.key, series.points.back().value));
  plot.set("remark", printable(remark_on(series, names_machine)));
  plot.set("svg", history_plot_svg(history, series, markers));
  return plot;
}

/// Series of one scene, and in it of one engine and budget, stand together. Gates of an engine are one group.
data scenes_data(const History& history, std::size_t markers) {
  const auto scene_of = [](const SeriesKey& key) { return std::tie(key.suite, key.scene, key.size); };
  const auto group_of = [](const SeriesKey& key) {
    return std::make_tuple(key.engine, key.measure == Measure::gate ? std::string("gates") : key.budget);
  };
  std::set<std::string> suites;
  for (const HistorySeries& series : history.series) suites.insert(series.key.suite);
  const bool names_machine = machines_of(history).size() > 1;
  data scenes(data::type::list);
  const auto& all = history.series;
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    std::set<std::tuple<std::string, std::string>> groups;
    for (; end < all.size() && scene_of(all[end].key) == scene_of(all[first].key); ++end)
      groups.insert(group_of(all[end].key));
    data scene, group_list(data::type::list);
    scene.set("name", printable(all[first].key.scene));
    scene.set("facts",
              printable(all[first].key.size + (suites.size() > 1 ? ", suite " + all[first].key.suite : std::string())));
    for (const auto& group : groups) {
      data made, plots(data::type::list);
      made.set("engine", printable(std::get<0>(group)));
      made.set("budget", printable(std::get<1>(group)));
      for (std::size_t i = first; i < end; ++i)
        if (group_of(all[i].key) == group) plots.push_back(plot_data(history, all[i], markers, names_machine));
      made.set("plots", plots);
      group_list.push_back(made);
    }
    scene.set("groups", group_list);
    scenes.push_back(scene);
  }
  return scenes;
}

bool has_instructions(const History& history) {
  return std::ranges::any_of(history.series, [](const auto& s) { return s.key.measure == Measure::instructions; });
}

}  // namespace

void write_history_page(const History& history, const std::string& name, const std::filesystem::path& out) {
  const std::vector<NamedStep> steps = steps_of(history);
  const std::size_t markers =
      std::clamp(markers_of_page / std::max<std::size_t>(1, history.series.size()), std::size_t{24}, most_markers);
  data page;
  set_style_and_script(page, std::string(templates::style) + std::string(history_templates::history_style),
                       history_templates::script, history_templates::script_sha256);
  page.set("name", printable(name));
  page.set("sentence", printable(last_step_sentence(history)));
  page.set("commits", std::to_string(history.commits.size()));
  page.set("series", std::to_string(history.series.size()));
  page.set("first", date_text(history.commits.front().date));
  page.set("last", date_text(history.commits.back().date));
  page.set("records", std::to_string(history.records));
  const std::set<std::string> machines = machines_of(history);
  page.set("has_machines", !machines.empty());
  page.set("machines", printable(fmt::format("{}", fmt::join(machines, "; "))));
  page.set("lacks_instructions", !machines.empty() && !has_instructions(history));
  page.set("has_steps", !steps.empty());
  page.set("steps", steps_data(history, steps));
  page.set("has_more_steps", steps.size() > most_steps);
  page.set("more_steps", std::to_string(steps.size() - std::min(steps.size(), most_steps)));
  page.set("scenes", scenes_data(history, markers));
  write_file_atomically(out, rendered_page(history_templates::history, page));
}

}  // namespace photonproof::reports::inline reports_history
