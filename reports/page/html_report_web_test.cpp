// The HTML report in a browser: it loads without messages, holds its scenes, and fits wide and narrow windows.

#include <string>
#include <vector>

#include "reports/page/html_report.h"
#include "reports/page/test_browser.h"

namespace photonproof::inline reports_page {
namespace {

using namespace reports;
namespace fs = std::filesystem;

class HtmlReportInBrowser : public testing::Test {
 protected:
  HtmlReportInBrowser() : page(folder.path() / "report.html") {
    write_sample_pictures(folder.path());
    Results results = sample_results();
    results.scenes[1].name += "<script>console.log('broke out')</script>";
    for (Result& result : results.results) {
      if (result.cell.scene == "hole") result.cell.scene = results.scenes[1].name;
    }
    results.engines[0].version = std::string(200, 'v');
    results.engines[1].title = "a title of many words " + std::string(100, 't');
    results.command = results.host.cpu = std::string(300, 'c');
    write_html_report(results, folder.path(), page);
  }

  TemporaryFolder folder;
  fs::path page;
};

TEST_F(HtmlReportInBrowser, loads_without_a_message_and_shows_every_scene) {
  const BrowserOutcome outcome = browse(page);
  for (const std::string& line : outcome.console) ADD_FAILURE() << line;
  EXPECT_EQ(count(outcome.dom, "data-scene="), 2u);
  EXPECT_EQ(count(outcome.dom, "data-scene=\"box\""), 1u);
  EXPECT_EQ(count(outcome.dom, "<script>"),
            1 + count(outcome.dom, "data-scene=\"hole<script>"));  // else only as a value
  EXPECT_EQ(count(outcome.dom, "role=\"img\" aria-label=\"Error against time for box\""), 1u);
  EXPECT_EQ(count(outcome.dom, "</footer>"), 1u);
}

TEST_F(HtmlReportInBrowser, every_picture_decodes) {
  const auto seen = drive(page, 1200, R"(
    await until(() => [...page.images].every((image) => image.complete));
    return [page.images.length, [...page.images].filter((image) => !image.naturalWidth).length];)");
  // The reference, an image and two maps, thumbnails of the first two, and three on top; none is broken.
  EXPECT_EQ(seen, (nlohmann::json{9, 0}));
}

TEST_F(HtmlReportInBrowser, nothing_sticks_out_of_a_wide_or_narrow_window) {
  for (const int width : {1200, 768, 390}) {
    const auto seen = drive(page, width, R"(
      page.querySelector(".scene").scrollIntoView();
      await until(() => page.querySelector(".viewer"));
      await drawn();
      return [page.documentElement.scrollWidth, page.documentElement.clientWidth];)");
    EXPECT_LE(seen[0], seen[1]) << width;
  }
}

TEST_F(HtmlReportInBrowser, every_control_has_a_name) {
  const auto seen = drive(page, 1200, R"(
    page.querySelector(".scene").scrollIntoView();
    await until(() => page.querySelector(".viewer"));
    const name = (node) => node.getAttribute("aria-label") || (node.labels && [...node.labels].map((l) => l.textContent).join("")) || node.textContent;
    const nodes = [...page.querySelectorAll("button, input, select, [tabindex], [role=slider], canvas")];
    return {count: nodes.length, nameless: nodes.filter((node) => !name(node).trim()).map((node) => node.outerHTML)};)");
  EXPECT_GT(seen["count"], 20);
  EXPECT_EQ(seen["nameless"], nlohmann::json::array());
}

TEST_F(HtmlReportInBrowser, details_of_many_measurements_are_unpacked_when_they_are_opened) {
  Results results = sample_results();
  for (std::uint64_t seed = 100; seed < 200; ++seed)
    results.results.push_back(finished("box", "photon", {"photons", 2000}, seed, 0.05));
  results.results.back().command = "photonproof render \"a scene\" & <b>more</b>";
  write_html_report(results, folder.path(), page);
  std::vector<std::string> console;
  const auto seen = drive(page, 1200, R"(
    const details = page.querySelector("details.packed"), before = details.querySelectorAll("h4").length;
    details.open = true;
    await until(() => details.querySelector("h4"));
    return [before, details.querySelectorAll("h4").length, details.querySelectorAll(".note, script, b").length,
            [...details.querySelectorAll("code.command")].filter((c) => c.textContent.includes("& <b>more")).length];)",
                          &console);
  EXPECT_EQ(seen, (nlohmann::json{0, 105, 0, 1}));
  EXPECT_EQ(console, std::vector<std::string>());
}

TEST_F(HtmlReportInBrowser, the_check_for_messages_sees_them) {
  std::ofstream(page) << "<!doctype html><script>console.error('seen')</script>";
  const BrowserOutcome outcome = browse(page);
  ASSERT_EQ(outcome.console.size(), 1u);
  EXPECT_NE(outcome.console[0].find("seen"), std::string::npos);
}

}  // namespace
}  // namespace photonproof::inline reports_page
