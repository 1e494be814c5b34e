#include "reports/page/html_report.h"

#include <cmath>

#include "harness/metrics/heatmap.h"
#include "reports/record/heatmap_magma.h"
#include "reports/view/test_sample_results.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_page {
namespace {

using namespace reports;
namespace fs = std::filesystem;

std::string html_of(const Results& results, bool with_pictures = true) {
  const TemporaryFolder folder;
  if (with_pictures) write_sample_pictures(folder.path());
  write_html_report(results, folder.path(), folder.path() / "report.html");
  return file_text(folder.path() / "report.html");
}

/// Removes the text between every `open` and `close`.
void blank(std::string& text, const std::string& open, const std::string& close) {
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    const std::size_t end = text.find(close, at);
    text.replace(at, end - at, "...");
  }
}

/// Removes bytes that depend on versions of libraries, and texts that have files of their own.
void blank_library_bytes(std::string& html) {
  blank(html, "data:image/png;base64,", "\"");
  blank(html, "\"pixels\":\"", "\"");
  blank(html, "<style>", "</style>");
  blank(html, "script-src 'sha256-", "'");
  blank(html, "<script>", "</script>");
}

TEST(HtmlReport, reads_like_its_snapshot) {
  std::string html = html_of(sample_results());
  blank_library_bytes(html);
  expect_snapshot("sample.html", html);
}

TEST(HtmlReport, conclusions_read_like_their_snapshot) {
  std::string html = html_of(sample_conclusions());
  blank_library_bytes(html);
  expect_snapshot("conclusions.html", html);
}

// The furnace is the box by another name. It is won by far, but in the same time errors differ on the box.
TEST(HtmlReport, shows_the_scene_whose_errors_in_the_same_time_differ_most) {
  Results results = sample_conclusions();
  results.gates.clear();
  results.scenes.push_back(results.scenes.front());
  results.scenes.back().name = "furnace";
  for (std::size_t i = 0, count = results.results.size(); i < count; ++i) {
    if (results.results[i].cell.scene != "box") continue;
    results.results.push_back(results.results[i]);
    results.results.back().cell.scene = "furnace";
  }
  RaceRecord& box = results.races.front();
  results.races.back() = box;
  RaceRecord& furnace = results.races.back();
  furnace.scene = "furnace";
  furnace.times[1].ratio = Estimate{90, Interval{80, 100}};
  furnace.errors.clear();
  const auto strip_of = [&] {
    const std::string html = html_of(results);
    const std::size_t at = html.find('>', html.find("<a href", html.find("id=\"strip\""))) + 1;
    return html.substr(at, html.find('<', at) - at);
  };
  EXPECT_EQ(strip_of(), "box");
  furnace.errors = box.errors;
  furnace.errors[1].ratio = Estimate{60, Interval{50, 70}};
  EXPECT_EQ(strip_of(), "furnace");
  box.errors[1].ratio = Estimate{20, Interval{11, 30}};
  EXPECT_EQ(strip_of(), "box") << "any eye sees both, and the suite has the box first";
  box.errors.clear();
  furnace.errors.clear();
  EXPECT_EQ(strip_of(), "furnace");
}

// The worst gate's first tile in the scene of 8 x 8 pixels.
TEST(HtmlReport, frames_the_place_where_a_gate_fails) {
  Results results = sample_conclusions();
  for (GateRecord& gate : results.gates) {
    gate.pictures = {{"image", "box.png"}, {"flip", "box-flip.png"}};
    if (gate.verdict == GateVerdict::fail) gate.tiles = {{2, 4, 3, 1, 2, ""}, {0, 0, 1, 1, 1, ""}};
  }
  const std::string frame =
      R"html(<span class="fault-place" title="3 by 1 pixels at (2, 4)" style="left:25.00%;top:50.00%;width:37.50%;height:12.50%">)html";
  EXPECT_EQ(count(html_of(results), frame), 3u) << "image, reference and difference";
  for (GateRecord& gate : results.gates) gate.tiles.clear();
  EXPECT_EQ(count(html_of(results), "class=\"fault-place\""), 0u);
}

TEST(HtmlReport, says_beside_the_failing_gate_that_its_reference_is_the_engines_own) {
  Results results = sample_conclusions();
  EXPECT_EQ(count(html_of(results), "Regression only: "), 0u);
  for (GateRecord& gate : results.gates) gate.regression_only = "the reference is by photon itself";
  EXPECT_EQ(count(html_of(results), "Regression only: the reference is by photon itself. Its gates show changes"), 1u);
}

/// Everything before the page's own script.
std::string without_script(const std::string& html) { return html.substr(0, html.rfind("<script>")); }

TEST(HtmlReport, refers_to_nothing_outside_itself) {
  const std::string html = html_of(sample_results());
  EXPECT_EQ(count(html, "http:"), 0u);
  EXPECT_EQ(count(html, "https:"), 0u);
  EXPECT_EQ(count(html, "url("), 0u);
  EXPECT_EQ(count(html, "@import"), 0u);
  EXPECT_EQ(count(html, "<script>"), 1u);
  EXPECT_EQ(count(html, "<script"), 1u + count(html, "<script type=\"application/json\" class=\"viewer-data\">"));
  EXPECT_EQ(count(html, "fetch("), 0u);
  EXPECT_EQ(count(html, "src="), count(html, "src=\"data:image/png;base64,"));
  // Links lead to a scene of the page or are the empty icon.
  EXPECT_EQ(count(html, "href="), count(html, "href=\"#scene-") + count(html, "href=\"data:,\""));
}

TEST(HtmlReport, every_picture_has_a_text) {
  const std::string html = html_of(sample_results());
  EXPECT_EQ(count(html, "<img"), 9u);  // reference, image and two maps; thumbnails of the first two; three on top
  EXPECT_EQ(count(html, "alt=\""), 9u);
  EXPECT_EQ(count(html, "alt=\"\""), 0u);
}

TEST(HtmlReport, escapes_every_text_of_the_record) {
  const std::string evil = "<script>alert(1)</script>\"'&{{suite}}\n|";
  Results results = sample_conclusions();
  results.suite = results.created = results.command = evil;
  results.caveats = {evil};
  results.host.cpu = results.host.os = results.host.kernel = evil;
  results.versions = {{evil, evil}};
  for (EngineRecord& engine : results.engines) engine = {engine.name + evil, evil, evil};
  for (SceneRecord& scene : results.scenes) {
    scene.name += evil;
    scene.path = scene.purpose = evil;
  }
  for (Result& result : results.results) {
    const bool is_reference = result.cell.engine == "path";
    result.cell.scene += evil;
    result.cell.engine += evil;
    result.cell.budget.kind += evil;
    if (is_reference) results.scenes[0].reference_label = result.cell.label();
    result.detail = result.image = result.engine_version = result.command = evil;
    if (!is_reference) result.pictures = {{"image", evil}, {"flip", evil}, {"error", evil}};
    result.phases = result.counts = {{evil, 1.0}};
    result.skipped = result.caveats = {evil};
    for (MetricValue& value : result.metrics) value.parameters = evil;
    result.metrics.push_back({evil, 1.0, evil});
  }
  for (GateRecord& gate : results.gates) {
    gate.scene += evil;
    gate.engine += evil;
    gate.name = gate.metric = gate.sentence = gate.command = evil;
    gate.skipped = {evil};
    for (FailingTile& tile : gate.tiles) tile.sentence = evil;
  }
  for (Convergence& curve : results.convergence) {
    curve.scene += evil;
    curve.engine += evil;
    curve.caveats = {evil};
  }
  for (ChangeRecord& change : results.changes) change.scene = change.engine = change.quantity = change.sentence = evil;
  results.scenes[1].reference->provenance = {{evil, evil}};
  const std::string html = html_of(results);
  EXPECT_EQ(count(html, "<script>"), 1u);
  EXPECT_EQ(count(html, "</script>"), 1u + count(html, "class=\"viewer-data\">"));
  const std::size_t in_page = count(html, "&lt;script&gt;alert(1)&lt;/script&gt;&quot;&apos;");
  const std::size_t in_json = count(html, "\\u003cscript>alert(1)\\u003c/script>\\\"'&{{suite}} |");
  EXPECT_EQ(count(html, "alert(1)"), in_page + in_json);
  EXPECT_GT(in_page, 100u);
  EXPECT_GT(in_json, 4u);
}

TEST(HtmlReport, says_where_a_picture_is_missing) {
  const std::string html = html_of(sample_results(), false);
  EXPECT_EQ(count(html, "<img"), 0u);
  EXPECT_EQ(count(html, "<div class=\"missing\" role=\"img\" aria-label=\"reference of box: path, 4096 spp\">"), 1u);
  EXPECT_EQ(count(html, "box-ref.png is missing"), 1u);
  EXPECT_EQ(count(html, "box-flip.png is missing"), 1u);
}

TEST(HtmlReport, a_run_without_a_finished_cell_is_still_a_page) {
  Results results = sample_results();
  for (Result& result : results.results) {
    result.status = Status::crash;
    result.detail = "killed by SIGSEGV";
    result.metrics.clear();
  }
  const std::string html = html_of(results);
  EXPECT_EQ(count(html, "6 images: 0 finished, 6 did not"), 1u);
  EXPECT_EQ(count(html, "No image has both an error and a time to plot."), 2u);
  EXPECT_EQ(count(html, "did not finish (crash): killed by SIGSEGV"), 1u);
  EXPECT_EQ(count(html, "<svg viewBox=\"0 0 560"), 0u);
}

TEST(HtmlReport, an_empty_record_is_still_a_page) {
  const std::string html = html_of(Results{});
  EXPECT_EQ(count(html, "This run has no scenes."), 1u);
  EXPECT_EQ(count(html, "</html>"), 1u);
}

TEST(HtmlReport, undefined_metrics_are_dashes) {
  Results results = sample_results();
  results.results[1].metrics.clear();
  // A cell without metrics has dashes in all six columns; so has the reference, and the cell of the scene without one.
  EXPECT_EQ(count(html_of(results), "<td class=\"number\">–</td>"), 6u + 6u + 6u + 7u);  // the timeout lacks memory too
}

TEST(HtmlReport, parameters_of_metrics_without_a_column_are_said_too) {
  Results results = sample_results();
  results.results[1].metrics.push_back({"flip_max", 0.5, "pixels_per_degree=67"});
  results.results[1].metrics.push_back({"flip_least", 0.5, "pixels_per_degree=67"});
  EXPECT_EQ(
      count(html_of(results), "<dd>flip_max, flip_least <span class=\"quiet\">(pixels_per_degree=67)</span></dd>"), 1u);
}

TEST(HtmlReport, the_scene_that_fails_comes_first_and_says_so_in_words) {
  const std::string html = html_of(sample_conclusions());
  EXPECT_LT(html.find("data-scene=\"hole\""), html.find("data-scene=\"box\""));
  EXPECT_EQ(count(html, "3 gates: 1 passes, 1 fails, 1 inconclusive"), 1u);
  EXPECT_EQ(count(html, "<p class=\"worst\">ring at the floor&apos;s contact: +6 % bias, 41 px</p>"), 2u);
  const std::size_t worst = html.find("data-tile=\"0\">+6 % at the floor"),
                    next = html.find("data-tile=\"1\">+4 % right");
  EXPECT_LT(worst, next);
  EXPECT_NE(next, std::string::npos);
}

TEST(HtmlReport, a_run_of_gates_alone_has_no_empty_columns_and_no_plot) {
  Results results = sample_conclusions();
  results.results.clear();
  results.convergence.clear();
  results.changes.clear();
  const std::string html = without_script(html_of(results));
  EXPECT_EQ(count(html, "not run"), 0u);
  EXPECT_EQ(count(html, "Error against time"), 0u);
  EXPECT_EQ(count(html, "Every measurement"), 0u);
  EXPECT_EQ(count(html, "class=\"viewer-data\""),
            1u);  // hole has a gate's image and a stored reference; box has neither
}

const char* const six_engines[] = {"reference", "a", "b", "c", "d", "e"};

/// Writes an image of noise, which compresses worst, with its picture and its FLIP map, for each engine.
void write_noise(const fs::path& folder) {
  std::uint32_t state = 1;
  for (const std::string engine : six_engines) {
    Image image(256, 256);
    for (float& value : image.rgb) {
      state = state * 1664525u + 1013904223u;
      value = static_cast<float>(state >> 8) / 0x1p24f;
    }
    write_exr((folder / (engine + ".exr")).string(), {image, std::nullopt, {}});
    write_png((folder / (engine + ".png")).string(), image);
    PngRows flip((folder / (engine + "-flip.png")).string(), 256, 256);
    std::vector<std::uint8_t> colours;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
      const std::uint32_t colour = magma_colours[static_cast<std::size_t>(255 * image.rgb[i])];
      for (const int shift : {16, 8, 0}) colours.push_back(static_cast<std::uint8_t>(colour >> shift));
    }
    flip.add(256, colours.data());
    flip.finish();
  }
}

/// A cell with as much text as `bench` records, in digits and names that no other cell has.
Result wordy_cell(const std::string& scene, const std::string& engine, std::uint64_t seed) {
  std::uint64_t state = std::hash<std::string>{}(scene + engine) + seed;
  const auto any = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  Result result = finished(scene, engine, {"spp", 4}, seed, 0.1 * any());
  const std::string folder = "cells/" + std::to_string(state) + std::to_string(state ^ state >> 7) + "-1/";
  result.command = "/opt/photonproof/build/release/bin/photonproof render /opt/photonproof/scenes/library/" + scene +
                   "/scene.xml --integrator " + engine + " -o out/many/" + folder + "image.exr --stats out/many/" +
                   folder + "stats.json --size 64x64 --threads 2 --checkpoint 0 --spp 4 --seed " + std::to_string(seed);
  result.wall_seconds = any();
  result.cpu_seconds = any();
  for (const char* phase : {"compile", "load", "render", "write"}) result.phases[phase] = 0.01 * any();
  for (const char* what : {"bytes_scene", "rays_bounce", "rays_camera", "rays_photon", "rays_shadow"})
    result.counts[what] = std::floor(1e5 * any());
  for (const char* metric : {"rmse", "mae", "max_abs", "bias_r", "bias_g", "bias_b", "relmse_jeri", "mrse_pbrt",
                             "smape", "flip_weighted_quartile1", "flip_weighted_median", "flip_max"})
    result.metrics.push_back({metric, any(), ""});
  result.skipped = {"bvh: 18 primitives, tested one after the other", "bsdf-groups: all BSDFs are of one kind",
                    "surface-detail: no textures, shading normals, tangents or nested BSDFs"};
  return result;
}

/// Ten scenes, each with a reference and `seeds` seeds of five engines.
Results ten_scenes(std::uint64_t seeds) {
  Results results;
  results.suite = "ten";
  for (int scene = 0; scene < 10; ++scene) {
    const std::string name = "scene" + std::to_string(scene);
    for (const std::string engine : six_engines) {
      for (std::uint64_t seed = 1; seed <= (engine == "reference" ? 1 : seeds); ++seed) {
        Result result = wordy_cell(name, engine, seed);
        result.image = engine + ".exr";
        result.pictures = {{"image", engine + ".png"}, {"flip", engine + "-flip.png"}, {"error", engine + ".png"}};
        results.results.push_back(std::move(result));
      }
    }
    results.scenes.push_back({name, "", "", 256, 256, 0, name + "/reference/spp=4/seed=1"});
  }
  return results;
}

std::string html_of_ten_scenes(std::uint64_t seeds) {
  const TemporaryFolder folder;
  write_noise(folder.path());
  write_html_report(ten_scenes(seeds), folder.path(), folder.path() / "report.html");
  return file_text(folder.path() / "report.html");
}

TEST(HtmlReport, ten_scenes_of_five_engines_take_less_than_5_MB) {
  const std::string html = html_of_ten_scenes(3);
  EXPECT_LT(html.size(), 5'000'000u);
  EXPECT_EQ(count(html, "pixels of the renders are averaged into one here"), 10u);
  EXPECT_EQ(count(html, "these pictures are reduced to"), 10u);
  EXPECT_EQ(count(html, "<dt>command</dt>"), 10u * 16);
}

// 10 x (1 + 5 x 50) measurements. Their text takes the room of the pictures, which become smaller; none is left out.
TEST(HtmlReport, twenty_five_hundred_measurements_take_less_than_5_MB) {
  const std::string html = html_of_ten_scenes(50);
  EXPECT_LT(html.size(), 5'000'000u);
  EXPECT_EQ(count(html, "<td><span class=\"state quiet\">finished</span></td>"), 2510u);
  EXPECT_EQ(count(html, "class=\"viewer-data\""), 10u);
  EXPECT_EQ(count(html, "these pictures are reduced to"), 10u);
  EXPECT_EQ(count(html, "class=\"packed-cells\""), 10u);
  EXPECT_EQ(count(html, "<dt>command</dt>"), 0u);
}

TEST(HtmlReport, scales_of_heat_maps_are_those_they_are_made_with) {
  const std::string html = html_of(sample_results());
  EXPECT_EQ(count(html, flip_scale_caption), 1u);
  EXPECT_EQ(count(html, error_scale_caption), 1u);
}

TEST(HtmlReport, a_file_that_cannot_be_written_is_an_input_error) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_html_report(sample_results(), folder.path(), folder.path() / "none" / "report.html"), InputError);
}

}  // namespace
}  // namespace photonproof::inline reports_page
