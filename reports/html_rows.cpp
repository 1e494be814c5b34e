#include "reports/html_rows.h"

#include <algorithm>

#include "reports/cell_details.h"
#include "reports/html_data.h"
#include "reports/metric_columns.h"
#include "reports/numbers.h"
#include "reports/text.h"

namespace photonproof::reports {
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

data row_data(const View& view, std::size_t engine, const Result& result, bool first, bool is_reference) {
  data row = engine_data(view, engine);
  set_cell(row, result.cell);
  set_status(row, result);
  if (is_reference) row.set("engine", printable(result.cell.engine + " (reference)"));
  data values(data::type::list);
  for (const MetricColumn& column : metric_columns()) values.push_back(metric_text(result, column.metric));
  row.set("values", values);
  row.set("wall", seconds_text(result.wall_seconds));
  row.set("cpu", seconds_text(result.cpu_seconds));
  row.set("peak", or_dash(result.peak_bytes, megabytes));
  row.set("first", first);
  row.set("reason", text_or_false(reason_text(result)));
  row.set("caveats", text_or_false(caveats_text(result)));
  row.set("width_of_table", std::to_string(7 + metric_columns().size()));
  row.set("details", details_data(result));
  row.set("has_command", !result.command.empty());
  row.set("command", printable(result.command));
  return row;
}

}  // namespace

data rows_data(const View& view, const SceneView& scene) {
  data rows(data::type::list);
  if (scene.reference) {
    const auto engine = std::ranges::find(view.engines, scene.reference->cell.engine, &EngineRecord::name);
    rows.push_back(
        row_data(view, static_cast<std::size_t>(engine - view.engines.begin()), *scene.reference, true, true));
  }
  for (const EngineOutcome& outcome : scene.engines) {
    for (const Result* cell : outcome.cells) {
      rows.push_back(row_data(view, outcome.engine, *cell, cell == outcome.cells.front(), false));
    }
  }
  return rows;
}

}  // namespace photonproof::reports
