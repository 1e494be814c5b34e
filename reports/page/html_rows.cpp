#include "reports/page/html_rows.h"

#include <fmt/format.h>

#include <cmath>

#include "reports/page/html_data.h"
#include "reports/view/cell_details.h"
#include "reports/view/metric_columns.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"
#include "reports/view/verdicts.h"

namespace photonproof::reports::inline reports_page {
namespace {

using kainjow::mustache::data;

data texts_data(const std::vector<std::string>& texts) {
  data list(data::type::list);
  for (const std::string& text : texts) list.push_back(printable(text));
  return list;
}

data details_data(const Result& result) {
  data list(data::type::list);
  for (const Detail& detail : cell_details(result)) {
    data item;
    item.set("term", detail.term);
    item.set("texts", texts_data(detail.texts));
    list.push_back(item);
  }
  return list;
}

/// Six digits of a fraction are more than any column shows.
std::string sort_text(double value) {
  return value == std::floor(value) ? fmt::format("{}", value) : fmt::format("{:.6g}", value);
}

data number_cell(const std::string& text, const std::optional<double>& sort) {
  data cell;
  cell.set("text", text);
  cell.set("sort", sort ? data(sort_text(*sort)) : data(false));
  return cell;
}

/// Numbers of the row: metrics, then time and memory.
data numbers_data(const SceneView& scene, const Result& result) {
  data list(data::type::list);
  for (const MetricColumn& column : metric_columns()) {
    const auto value = metric(result, column.metric);
    list.push_back(number_cell(metric_text(result, column.metric) + (value ? doubt_mark(scene) : ""), value));
  }
  list.push_back(number_cell(seconds_text(result.wall_seconds), result.wall_seconds));
  list.push_back(number_cell(seconds_text(result.cpu_seconds), result.cpu_seconds));
  const auto bytes = result.peak_bytes ? std::optional(static_cast<double>(*result.peak_bytes)) : std::nullopt;
  list.push_back(number_cell(or_dash(result.peak_bytes, megabytes), bytes));
  return list;
}

data row_data(const View& view, const SceneView& scene, std::size_t engine, const Result& result, bool first) {
  const bool is_reference = &result == scene.reference;
  data row = engine_data(view, engine);
  set_cell(row, result.cell);
  set_status(row, result);
  if (is_reference) row.set("engine", printable(result.cell.engine + " (reference)"));
  row.set("budget_sort", result.cell.budget.amount_text());
  row.set("numbers", numbers_data(scene, result));
  row.set("first", first);
  row.set("reason", text_or_false(reason_text(result)));
  row.set("caveats", text_or_false(caveats_text(result)));
  row.set("width_of_table", std::to_string(7 + metric_columns().size()));
  row.set("details", details_data(result));
  row.set("has_command", !result.command.empty());
  row.set("command", printable(result.command));
  row.set("compare", text_or_false(compare_command(scene, result)));
  return row;
}

}  // namespace

data rows_data(const View& view, const SceneView& scene) {
  data rows(data::type::list);
  if (scene.reference) {
    rows.push_back(row_data(view, scene, engine_index(view, scene.reference->cell.engine), *scene.reference, true));
  }
  for (const EngineOutcome& outcome : scene.engines) {
    for (const Result* cell : outcome.cells) {
      rows.push_back(row_data(view, scene, outcome.engine, *cell, cell == outcome.cells.front()));
    }
  }
  return rows;
}

}  // namespace photonproof::reports::inline reports_page
