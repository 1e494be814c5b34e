#include "reports/page/html_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/page/html_cards.h"
#include "reports/page/html_conclusions.h"
#include "reports/page/html_data.h"
#include "reports/page/html_rows.h"
#include "reports/page/page_parts.h"
#include "reports/page/templates.h"
#include "reports/page/viewer_data.h"
#include "reports/plots/error_plot.h"
#include "reports/view/cell_details.h"
#include "reports/view/conclusions.h"
#include "reports/view/deflated.h"
#include "reports/view/text.h"
#include "reports/view/verdicts.h"

namespace photonproof::reports::inline reports_page {
namespace {

using kainjow::mustache::data;
namespace fs = std::filesystem;

// A page of ten scenes stays below 5 MB: 10 x 460 kB leave 400 kB for style, script and the parts about all scenes.
// Pictures use what a scene's text leaves, as long as they stay recognisable.
constexpr std::size_t scene_bytes = 460'000, most_picture_bytes = 435'000, least_picture_bytes = 80'000;
constexpr double share_of_gallery = 0.4;
// Above this number of measurements their details are packed: 2 kB of text each become 0.2 kB.
constexpr std::size_t most_open_details = 60;

/// A thumbnail for the index, with its alternative text.
data shown_data(const fs::path& folder, const std::string& file, const std::string& alt, std::size_t& bytes) {
  constexpr int thumbnail_side = 64;  // CSS pixels, as .thumbnail
  const EmbeddedPicture thumbnail = embed_thumbnail(folder, file, thumbnail_side);
  bytes += thumbnail.uri.size();
  data out;
  out.set("has_thumbnail", thumbnail.problem.empty());
  out.set("thumbnail", thumbnail.uri);
  out.set("alt", printable(alt));
  return out;
}

data correctness_data(const Convergence& curve, const ConvergencePoint& point) {
  data out;
  set_correctness(out, *point.correctness);
  out.set("of", printable(curve.engine + ", " + budget_text(point.budget)));
  return out;
}

data outcome_data(const View& view, const SceneView& scene, const EngineOutcome& outcome, const fs::path& folder,
                  std::size_t& bytes) {
  data out;
  out.set("name", printable(view.engines[outcome.engine].name));
  out.set("shown", false);
  out.set("has_correctness", false);
  out.set("sort", data(false));
  if (outcome.shown) {
    const Result& result = *outcome.shown;
    data shown = shown_data(folder, picture_file(result.pictures, "image"),
                            result.cell.scene + " by " + result.cell.engine, bytes);
    shown.set("wall", seconds_text(result.wall_seconds));
    shown.set("relmse", metric_text(result, "relmse") + doubt_mark(scene));
    shown.set("ssim", metric_text(result, "ssim") + doubt_mark(scene));
    if (const CorrectnessRecord* record = correctness_of(scene, result.cell)) set_correctness(out, *record);
    out.set("shown", shown);
    if (const auto relmse = metric(result, "relmse")) out.set("sort", fmt::format("{}", *relmse));
  }
  out.set("state", state_text(outcome));
  out.set("class", outcome.cells.empty() ? "quiet" : outcome.finished == outcome.cells.size() ? "quiet" : "poor");
  return out;
}

data reference_data(const SceneView& scene, const fs::path& folder, std::size_t& bytes) {
  if (!has_reference(scene)) return data(false);
  data out = shown_data(folder, reference_picture(scene), scene.record.name + ", reference", bytes);
  data lines(data::type::list);
  for (std::string rest = reference_caption(scene); !rest.empty();) {
    const std::size_t comma = std::min(rest.find(", "), rest.size());
    lines.push_back(printable(rest.substr(0, comma)));
    rest.erase(0, comma + 2);
  }
  out.set("lines", lines);
  return out;
}

data plot_data(const View& view, const ErrorPlot& plot, const std::string& name) {
  data out, legend(data::type::list);
  std::optional<std::size_t> last;
  for (const PlotSeries& series : plot.series) {
    if (last != series.engine) legend.push_back(engine_data(view, series.engine));
    last = series.engine;
  }
  out.set("svg", error_plot_svg(plot, "Error against time for " + name));
  out.set("legend", legend);
  out.set("over_seeds", plot.over_seeds);
  out.set("left_out", plot.left_out == 0 ? data(false) : data(std::to_string(plot.left_out)));
  return out;
}

void set_curves(data& out, const View& view, const SceneView& scene) {
  const ErrorPlot plot = error_plot(view, scene);
  out.set("has_plot", !plot.series.empty());
  out.set("has_no_plot", plot.series.empty() && !view.compared.empty());
  out.set("plot", plot.series.empty() ? data(false) : plot_data(view, plot, scene.record.name));
  out.set("slopes", table_data(slopes_table(scene.curves), 1));
  out.set("points", table_data(points_table(scene.curves, doubt_mark(scene)), 4));
  data verdicts(data::type::list);
  for (const Convergence* curve : scene.curves)
    for (const ConvergencePoint& point : curve->points)
      if (point.correctness) verdicts.push_back(correctness_data(*curve, point));
  out.set("has_correctness_list", verdicts.is_non_empty_list());
  out.set("correctness_list", verdicts);
  data caveats(data::type::list);
  for (const Convergence* curve : scene.curves) {
    for (const std::string& caveat : curve->caveats) caveats.push_back(printable(curve->engine + ": " + caveat));
  }
  out.set("curve_caveats", caveats);
}

std::string facts_text(const SceneRecord& record) {
  std::string text;
  if (record.width > 0 && record.height > 0) text = fmt::format("{} × {} pixels, ", record.width, record.height);
  text += "all pictures at " + exposure_text(record.exposure);
  return record.path.empty() ? text : text + ", " + record.path;
}

void set_images(data& out, const View& view, const SceneView& scene, const fs::path& folder, const std::string& id,
                std::size_t bytes) {
  const std::vector<SceneImage> images = scene_images(view, scene);
  const auto for_gallery = static_cast<std::size_t>(share_of_gallery * static_cast<double>(bytes));
  const Gallery shown = gallery(view, scene, images, folder, id, for_gallery);
  // The gallery's smallest pictures may be larger than its share; the viewer gets at least half of all bytes.
  const std::size_t for_viewer = std::max(bytes, shown.bytes + bytes / 2) - shown.bytes;
  const std::string json = viewer_json(view, scene, images, folder, id, for_viewer);
  out.set("has_cards", shown.cards.is_non_empty_list());
  out.set("cards", shown.cards);
  out.set("reduced_to", shown.longest_side == 0 ? data(false) : data(std::to_string(shown.longest_side)));
  out.set("has_viewer", !json.empty());
  out.set("viewer_json", json);
}

void set_rows(data& out, const View& view, const SceneView& scene) {
  data rows = rows_data(view, scene);
  out.set("has_rows", rows.is_non_empty_list());
  out.set("rows", rows);
  out.set("packed_details", data(false));
  if (rows.list_value().size() <= most_open_details) return;
  data details;
  set_scene_partials(details);
  details.set("rows", rows);
  out.set("packed_details", base64(deflated(rendered_page(templates::cell_details, details))));
}

/// Bytes for a scene's other pictures, besides its text and its thumbnails.
std::size_t picture_bytes(data& scene_without_pictures, std::size_t thumbnail_bytes) {
  set_scene_partials(scene_without_pictures);
  const std::size_t text = rendered_page(templates::scene_section, scene_without_pictures).size();
  const std::size_t left = std::min(scene_bytes - std::min(scene_bytes, text), most_picture_bytes);
  return std::max(left - std::min(left, thumbnail_bytes), least_picture_bytes);
}

data skips_data(const SceneView& scene) {
  std::vector<const Result*> cells;
  for (const EngineOutcome& outcome : scene.engines) {
    cells.insert(cells.end(), outcome.cells.begin(), outcome.cells.end());
  }
  data list(data::type::list);
  for (const std::string& text : skips_texts(cells, scene.gates)) list.push_back(printable(text));
  return list;
}

data provenance_data(const SceneView& scene) {
  data list(data::type::list);
  if (scene.reference || !scene.record.reference) return list;
  const auto add = [&](const std::string& term, const std::string& text) {
    if (text.empty()) return;
    data item;
    item.set("term", printable(term));
    item.set("text", printable(text));
    list.push_back(item);
  };
  add("file", scene.record.reference->file);
  for (const auto& [term, text] : scene.record.reference->provenance) add(term, text);
  return list;
}

}  // namespace

void set_scene_partials(data& object) {
  set_partial(object, "swatch_svg", templates::swatch_svg);
  set_partial(object, "cell_details", templates::cell_details);
  set_partial(object, "picture_img", templates::picture_img);
  set_partial(object, "verdict_chip", templates::verdict_chip);
  set_partial(object, "gates_table", templates::gates_table);
  set_partial(object, "plain_table", templates::plain_table);
}

data scene_data(const View& view, const SceneView& scene, const fs::path& folder, const std::string& id) {
  data out, outcomes(data::type::list);
  std::size_t thumbnail_bytes = 0;
  for (const EngineOutcome& outcome : scene.engines) {
    outcomes.push_back(outcome_data(view, scene, outcome, folder, thumbnail_bytes));
  }
  out.set("id", id);
  out.set("name", printable(scene.record.name));
  out.set("purpose", text_or_false(scene.record.purpose));
  out.set("facts", printable(facts_text(scene.record)));
  out.set("reference", reference_data(scene, folder, thumbnail_bytes));
  out.set("reference_problem", text_or_false(scene.reference_problem));
  out.set("doubt", text_or_false(doubt_text(scene)));
  out.set("wide", scene.record.width >= 400);
  out.set("outcomes", outcomes);
  out.set("has_verdict", scene.verdict.has_value());
  if (scene.verdict) {
    set_verdict(out, *scene.verdict);
    out.set("verdicts", verdicts_text(scene.gates));
    out.set("worst", text_or_false(*scene.verdict == GateVerdict::pass ? "" : scene.gates.front()->sentence));
  }
  set_curves(out, view, scene);
  set_gates(out, scene.gates, true);
  set_rows(out, view, scene);
  out.set("has_parameters", !scene.parameters.empty());
  out.set("parameters", parameters_data(scene.parameters));
  data skips = skips_data(scene);
  out.set("has_skips", skips.is_non_empty_list());
  out.set("skips", skips);
  data provenance = provenance_data(scene);
  out.set("has_provenance", provenance.is_non_empty_list());
  out.set("provenance", provenance);
  set_images(out, view, scene, folder, id, picture_bytes(out, thumbnail_bytes));
  return out;
}

}  // namespace photonproof::reports::inline reports_page
