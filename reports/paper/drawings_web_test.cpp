// An SVG alone in Chromium.
#include "reports/page/test_browser.h"
#include "reports/paper/canvas.h"
#include "reports/paper/paper_formats.h"
#include "reports/paper/test_figure_results.h"

namespace photonproof::inline reports_paper {
namespace {

using namespace reports;

TEST(DrawingsInChromium, svg_shows_alone_without_a_message) {
  if (!can_draw()) GTEST_SKIP() << "built without Cairo (Debian: libcairo2-dev)";
  const TemporaryFolder folder;
  const Results results = figure_results(folder.path());
  write_svg_report(sample_conclusions(), folder.path(), folder.path() / "plot.svg", {});
  write_inset_figure(results, folder.path(), folder.path() / "figure.svg", {.scene = "box", .insets = {{1, 1, 4, 4}}});
  for (const char* name : {"plot.svg", "figure.svg"}) {
    const BrowserOutcome outcome = browse(folder.path() / name);
    EXPECT_TRUE(outcome.console.empty()) << outcome.console.front();
    EXPECT_EQ(outcome.dom.find("parsererror"), std::string::npos);
    EXPECT_NE(outcome.dom.find("<svg"), std::string::npos) << outcome.dom.substr(0, 300);
  }
}

}  // namespace
}  // namespace photonproof::inline reports_paper
