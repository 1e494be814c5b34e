#include "reports/html_report.h"

#include "harness/heatmap.h"
#include "reports/sample_results.h"
#include "scenes/input_error.h"

namespace photonproof {
namespace {

using namespace reports;
namespace fs = std::filesystem;

std::string html_of(const Results& results, bool with_pictures = true) {
  const TemporaryFolder folder;
  if (with_pictures) write_sample_pictures(folder.path());
  write_html_report(results, folder.path(), folder.path() / "report.html");
  return file_text(folder.path() / "report.html");
}

/// Replaces what stands between `open` and `close` each time.
void blank(std::string& text, const std::string& open, const std::string& close) {
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    const std::size_t end = text.find(close, at);
    text.replace(at, end - at, "...");
  }
}

TEST(HtmlReport, reads_like_its_snapshot) {
  std::string html = html_of(sample_results());
  blank(html, "data:image/png;base64,", "\"");
  blank(html, "<style>", "</style>");
  blank(html, "aria-label=\"Error against time for box\">", "</svg>");
  expect_snapshot("sample.html", html);
}

TEST(HtmlReport, refers_to_nothing_outside_itself) {
  const std::string html = html_of(sample_results());
  EXPECT_EQ(count(html, "http:"), 0u);
  EXPECT_EQ(count(html, "https:"), 0u);
  EXPECT_EQ(count(html, "url("), 0u);
  EXPECT_EQ(count(html, "@import"), 0u);
  EXPECT_EQ(count(html, "<script"), 0u);
  EXPECT_EQ(count(html, "src="), count(html, "src=\"data:image/png;base64,"));
  // Links lead to a scene of the page, to a marker of a plot, or are the empty icon.
  EXPECT_EQ(count(html, "href="),
            count(html, "href=\"#scene-") + count(html, "href='#scene-") + count(html, "href=\"data:,\""));
}

TEST(HtmlReport, every_picture_has_a_text) {
  const std::string html = html_of(sample_results());
  EXPECT_EQ(count(html, "<img"), 6u);  // reference, image and two maps; thumbnails of the first two
  EXPECT_EQ(count(html, "alt=\""), 6u);
  EXPECT_EQ(count(html, "alt=\"\""), 0u);
}

TEST(HtmlReport, escapes_every_text_of_the_record) {
  const std::string evil = "<script>alert(1)</script>\"'&{{suite}}\n|";
  Results results = sample_results();
  results.suite = results.created = results.command = evil;
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
    result.pictures = {{"image", evil}, {"flip", evil}, {"error", evil}};
    result.phases = result.counts = {{evil, 1.0}};
    result.skipped = result.caveats = {evil};
    for (MetricValue& value : result.metrics) value.parameters = evil;
    result.metrics.push_back({evil, 1.0, evil});
  }
  const std::string html = html_of(results);
  EXPECT_EQ(count(html, "<script"), 0u);
  EXPECT_EQ(count(html, "alert(1)"), count(html, "&lt;script&gt;alert(1)&lt;/script&gt;&quot;&apos;&amp;{{suite}} |"));
  EXPECT_GT(count(html, "alert(1)"), 60u);
}

TEST(HtmlReport, says_where_a_picture_is_missing) {
  const std::string html = html_of(sample_results(), false);
  EXPECT_EQ(count(html, "<img"), 0u);
  EXPECT_EQ(count(html, "<div class=\"missing\" role=\"img\" aria-label=\"reference of box by path\">"), 1u);
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
  EXPECT_EQ(count(html, "6 cells: 0 finished, 6 did not"), 1u);
  EXPECT_EQ(count(html, "No cell has both an error and a time to plot."), 2u);
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

TEST(HtmlReport, says_when_gnuplot_is_missing) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const std::string html = html_of(sample_results());
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(count(html, "Not drawn: gnuplot is not installed. The table below has the numbers."), 1u);
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
}  // namespace photonproof
