#include "reports/page/html_data.h"

#include "reports/view/engine_style.h"
#include "reports/view/metric_columns.h"
#include "reports/view/numbers.h"
#include "reports/view/text.h"
#include "reports/view/verdicts.h"

namespace photonproof::reports::inline reports_page {

using kainjow::mustache::data;

data engine_data(const View& view, std::size_t engine) {
  const EngineRecord& record = view.engines[engine];
  const EngineStyle style = engine_style(engine);
  data out;
  out.set("color", engine_color(engine));
  out.set("shape", style.svg_shape);
  out.set("name", printable(record.name));
  out.set("title", printable(record.title));
  out.set("version", printable(record.version));
  return out;
}

data parameters_data(const std::vector<MetricParameters>& parameters) {
  data list(data::type::list);
  for (const MetricParameters& entry : parameters) {
    data item;
    item.set("metric", printable(entry.metric));
    item.set("parameters", printable(entry.parameters));
    list.push_back(item);
  }
  return list;
}

void set_status(data& object, const Result& result) {
  object.set("status", status_text(result.status));
  object.set("class", result.status == Status::ok ? "quiet" : "poor");
  object.set("detail", printable(result.detail));
}

void set_cell(data& object, const Cell& cell) {
  object.set("scene", printable(cell.scene));
  object.set("engine", printable(cell.engine));
  object.set("budget", printable(budget_text(cell.budget)));
  object.set("seed", std::to_string(cell.seed));
}

void set_picture(data& object, const EmbeddedPicture& picture, const std::string& alt) {
  constexpr int card_width = 256;  // CSS pixels, as .gallery > figure: a smaller picture is enlarged
  object.set("has_picture", picture.problem.empty());
  object.set("crisp", picture.width <= card_width);
  object.set("uri", picture.uri);
  object.set("width", std::to_string(picture.width));
  object.set("height", std::to_string(picture.height));
  object.set("problem", printable(picture.problem));
  object.set("alt", printable(alt));
}

std::string metric_text(const Result& result, const std::string& name) {
  return or_dash(metric(result, name), [&](double value) { return format_metric(name, value); });
}

std::string seconds_text(const std::optional<double>& seconds) {
  return or_dash(seconds, [](double value) { return significant(value); });
}

data text_or_false(const std::string& text) { return text.empty() ? data(false) : data(printable(text)); }

}  // namespace photonproof::reports::inline reports_page
