#include "reports/html_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/cell_details.h"
#include "reports/error_plot.h"
#include "reports/gnuplot.h"
#include "reports/html_data.h"
#include "reports/html_rows.h"
#include "reports/text.h"

namespace photonproof::reports {
namespace {

using kainjow::mustache::data;
namespace fs = std::filesystem;

data shown_data(const Result& result, const fs::path& folder) {
  constexpr int thumbnail_side = 64;  // CSS pixels, as .thumbnail
  const EmbeddedPicture thumbnail = embed_thumbnail(folder, picture_file(result, "image"), thumbnail_side);
  data out;
  set_cell(out, result.cell);
  out.set("has_thumbnail", thumbnail.problem.empty());
  out.set("thumbnail", thumbnail.uri);
  out.set("alt", printable(result.cell.scene + " by " + result.cell.engine));
  out.set("wall", seconds_text(result.wall_seconds));
  out.set("relmse", metric_text(result, "relmse"));
  out.set("ssim", metric_text(result, "ssim"));
  return out;
}

data outcome_data(const View& view, const EngineOutcome& outcome, const fs::path& folder) {
  data out;
  out.set("name", printable(view.engines[outcome.engine].name));
  out.set("shown", outcome.shown ? shown_data(*outcome.shown, folder) : data(false));
  out.set("state", state_text(outcome));
  out.set("class", outcome.cells.empty() ? "quiet" : outcome.finished == outcome.cells.size() ? "good" : "poor");
  return out;
}

data map_data(const Result& result, const fs::path& folder, const char* role, const char* alt, const char* title,
              const char* metric) {
  data out;
  set_picture(out, embed_picture(folder, picture_file(result, role)),
              fmt::format("{} of {} by {}", alt, result.cell.scene, result.cell.engine));
  out.set("caption", fmt::format("{} {}", title, metric_text(result, metric)));
  return out;
}

data reference_card(const Result& reference, const fs::path& folder) {
  data out;
  set_picture(out, embed_picture(folder, picture_file(reference, "image")),
              "reference of " + reference.cell.scene + " by " + reference.cell.engine);
  out.set("has_swatch", false);
  out.set("title", "reference");
  out.set("caption", printable(reference.cell.engine + ", " + budget_text(reference.cell.budget) + ", " +
                               seconds_text(reference.wall_seconds) + " s"));
  out.set("has_maps", false);
  out.set("has_scales", true);  // the room below it is where the others have their heat maps
  return out;
}

data engine_card(const View& view, const SceneView& scene, const EngineOutcome& outcome, const fs::path& folder) {
  data out = engine_data(view, outcome.engine);
  out.set("has_swatch", true);
  out.set("title", printable(view.engines[outcome.engine].name));
  out.set("has_maps", outcome.shown && scene.reference);
  out.set("has_scales", false);
  if (!outcome.shown) {
    const Result& failed = *outcome.cells.back();
    set_picture(out, {{}, 0, 0, "no picture: " + to_string(failed.status)}, "no picture by " + failed.cell.engine);
    out.set("caption", printable(failed.detail));
    return out;
  }
  const Result& shown = *outcome.shown;
  set_picture(out, embed_picture(folder, picture_file(shown, "image")),
              shown.cell.scene + " rendered by " + shown.cell.engine);
  out.set("caption", printable(budget_text(shown.cell.budget) + ", " + seconds_text(shown.wall_seconds) + " s"));
  data maps(data::type::list);
  maps.push_back(map_data(shown, folder, "flip", "FLIP map", "FLIP", "flip"));
  maps.push_back(map_data(shown, folder, "error", "relative error map", "relMSE", "relmse"));
  out.set("maps", maps);
  return out;
}

data plot_data(const View& view, const ErrorPlot& plot, const std::string& svg) {
  data out, legend(data::type::list);
  std::optional<std::size_t> last;
  for (const PlotSeries& series : plot.series) {
    if (last != series.engine) legend.push_back(engine_data(view, series.engine));
    last = series.engine;
  }
  out.set("svg", svg);
  out.set("legend", legend);
  out.set("left_out", plot.left_out == 0 ? data(false) : data(std::to_string(plot.left_out)));
  return out;
}

void set_plot(data& out, const View& view, const SceneView& scene, const std::string& id) {
  out.set("plot", false);
  out.set("plot_problem", false);
  const ErrorPlot plot = error_plot(scene);
  if (plot.series.empty()) {
    out.set("plot_problem", "No cell has both an error and a time to plot.");
    return;
  }
  const PlotOutcome drawn = run_gnuplot(gnuplot_script(plot));
  const std::string label = kainjow::mustache::html_escape(printable("Error against time for " + scene.record.name));
  const std::string svg = inline_svg(drawn.svg, id + "-", "role=\"img\" aria-label=\"" + label + "\"");
  if (svg.empty()) {
    const std::string problem = drawn.problem.empty() ? "gnuplot wrote an unknown layout" : drawn.problem;
    out.set("plot_problem", printable("Not drawn: " + problem + ". The table below has the numbers."));
  } else {
    out.set("plot", plot_data(view, plot, svg));
  }
}

std::string facts_text(const SceneRecord& record) {
  std::string text;
  if (record.width > 0 && record.height > 0) text = fmt::format("{} × {} pixels, ", record.width, record.height);
  text += "all pictures at " + exposure_text(record.exposure);
  return record.path.empty() ? text : text + ", " + record.path;
}

}  // namespace

data scene_data(const View& view, const SceneView& scene, const fs::path& folder, const std::string& id) {
  data out, outcomes(data::type::list), cards(data::type::list);
  if (scene.reference) cards.push_back(reference_card(*scene.reference, folder));
  for (const EngineOutcome& outcome : scene.engines) {
    outcomes.push_back(outcome_data(view, outcome, folder));
    if (!outcome.cells.empty()) cards.push_back(engine_card(view, scene, outcome, folder));
  }
  out.set("id", id);
  out.set("name", printable(scene.record.name));
  out.set("purpose", text_or_false(scene.record.purpose));
  out.set("facts", printable(facts_text(scene.record)));
  out.set("reference", scene.reference ? shown_data(*scene.reference, folder) : data(false));
  out.set("reference_problem", text_or_false(scene.reference_problem));
  out.set("wide", scene.record.width >= 400);
  out.set("outcomes", outcomes);
  out.set("cards", cards);
  set_plot(out, view, scene, id);
  data rows = rows_data(view, scene);
  out.set("has_rows", rows.is_non_empty_list());
  out.set("rows", rows);
  out.set("has_parameters", !scene.parameters.empty());
  out.set("parameters", parameters_data(scene.parameters));
  return out;
}

}  // namespace photonproof::reports
