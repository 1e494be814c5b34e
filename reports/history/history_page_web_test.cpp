// The page of a history in a browser: it fits a phone, its table sorts, and its plots tell their values.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reports/history/history_page.h"
#include "reports/page/test_browser.h"
#include "scenes/files/test_folder.h"

namespace photonproof::reports::inline reports_history {
namespace {

class HistoryPageInBrowser : public FolderTest {
 protected:
  /// A step of two series, with names that are long for a phone.
  std::filesystem::path page() const {
    History history;
    for (int i = 0; i < 20; ++i)
      history.commits.push_back({"0123456789abcdef0123456789abcdef012345" + std::to_string(10 + i), 86'400 * i});
    for (const Measure measure : {Measure::processor_seconds, Measure::instructions, Measure::relmse}) {
      HistorySeries series;
      series.key = {"suite",
                    "a-scene-with-a-very-long-name-of-many-words-" + std::string(40, 'x'),
                    "1920x1080",
                    "photonmapper",
                    "1000000 photons",
                    measure,
                    "AMD EPYC 7763 64-Core Processor, 64 cores"};
      for (std::size_t i = 0; i < 20; ++i) series.points.push_back({i, i < 12 ? 1.0 : 1.2, {}, 3, {}});
      series.levels = {1};
      if (measure != Measure::relmse) {
        series.steps.push_back({12, 1, 1.2, true, 0.2, Interval{0.15, 0.25}});
        series.levels.push_back(1.2);
      }
      history.series.push_back(series);
    }
    history.records = 20;
    write_history_page(history, "history.db", folder_ / "page.html");
    return folder_ / "page.html";
  }
};

TEST_F(HistoryPageInBrowser, fits_every_width_without_a_message) {
  for (const int width : {1200, 768, 390}) {
    std::vector<std::string> console;
    const nlohmann::json widths = drive(page(), width, R"(
      return [page.documentElement.scrollWidth, page.documentElement.clientWidth];)",
                                        &console);
    EXPECT_LE(widths.at(0).get<int>(), widths.at(1).get<int>()) << width;
    EXPECT_TRUE(console.empty()) << console.front();
  }
}

TEST_F(HistoryPageInBrowser, plots_tell_their_values_and_the_table_sorts) {
  const nlohmann::json seen = drive(page(), 1200, R"(
    const plot = page.querySelector("figure.plot"), svg = plot.querySelector("svg");
    await key(svg, "ArrowRight");
    const first = plot.querySelector(".tip").textContent;
    const quantities = () => [...page.querySelectorAll("table.steps tbody tr")].map((row) => row.cells[1].textContent);
    const before = quantities();
    page.querySelectorAll("table.steps thead button")[1].click();
    await drawn();
    return [first, before, quantities(), page.querySelectorAll(".step").length];)");
  EXPECT_EQ(seen, nlohmann::json::parse(R"(["0123456789: 1.00 s", ["processor time", "instructions"],
                                            ["instructions", "processor time"], 2])"));
}

}  // namespace
}  // namespace photonproof::reports::inline reports_history
