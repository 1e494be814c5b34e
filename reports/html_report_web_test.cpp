// The HTML report in a browser: it loads without a complaint, holds its scenes, and fits wide and narrow windows.

#include <string>
#include <vector>

#include "reference/process.h"
#include "reports/html_report.h"
#include "reports/sample_results.h"

namespace photonproof {
namespace {

using namespace reports;
namespace fs = std::filesystem;

struct BrowserOutcome {
  std::string dom;
  std::vector<std::string> console;  ///< one line a message
};

/// Loads a file in headless Chromium. Fails the test when there is no Chromium: ./check installs it.
BrowserOutcome browse(const fs::path& page) {
  const TemporaryFolder profile;
  ProcessOptions options;
  options.wall_limit_seconds = 60;
  const ProcessOutcome outcome =
      run_process({"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                   "--disable-background-networking", "--disable-component-update", "--disable-sync",
                   "--window-size=1200,900", "--user-data-dir=" + profile.path().string(), "--enable-logging=stderr",
                   "--dump-dom", "file://" + page.string()},
                  options);
  if (!outcome.ok()) {
    ADD_FAILURE() << "chromium " << outcome.sentence() << "; this test needs Debian's package chromium\n"
                  << outcome.standard_error;
  }
  BrowserOutcome result{outcome.standard_output, {}};
  const std::string& log = outcome.standard_error;
  for (std::size_t at = log.find(":CONSOLE"); at != std::string::npos; at = log.find(":CONSOLE", at + 1)) {
    result.console.push_back(log.substr(at, log.find('\n', at) - at));
  }
  return result;
}

std::string attribute_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

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

  /// The page within a frame `width` pixels wide, and a script beside it that writes what it measures as
  /// `name="value"` attributes of the document.
  BrowserOutcome measure(int width, const std::string& expression) {
    const fs::path wrapper = folder.path() / "wrapper.html";
    // The report forbids every script; the frame's copy has to let the wrapper look inside, not run one, so it stays.
    std::ofstream(wrapper)
        << "<!doctype html><title>wrapper</title><link rel=icon href='data:,'><iframe id=frame style='width:" << width
        << "px;height:800px;border:0' srcdoc=\"" << attribute_escaped(file_text(page))
        << "\"></iframe><script>onload = () => { const page = "
           "document.getElementById('frame').contentDocument;"
           "document.documentElement.setAttribute('measured', "
        << expression << "); document.getElementById('frame').remove(); };</script>";
    return browse(wrapper);
  }

  TemporaryFolder folder;
  fs::path page;
};

TEST_F(HtmlReportInBrowser, loads_without_a_message_and_shows_every_scene) {
  const BrowserOutcome outcome = browse(page);
  for (const std::string& line : outcome.console) ADD_FAILURE() << line;
  EXPECT_EQ(count(outcome.dom, "data-scene="), 2u);
  EXPECT_EQ(count(outcome.dom, "data-scene=\"box\""), 1u);
  EXPECT_EQ(count(outcome.dom, "<script>"), count(outcome.dom, "data-scene=\"hole<script>"));  // only as a value
  EXPECT_EQ(count(outcome.dom, "role=\"img\" aria-label=\"Error against time for box\""), 1u);
  EXPECT_EQ(count(outcome.dom, "</footer>"), 1u);
}

TEST_F(HtmlReportInBrowser, every_picture_decodes) {
  const BrowserOutcome outcome = measure(
      1200, "page.images.length + ' pictures, ' + [...page.images].filter(i => !i.naturalWidth).length + ' broken'");
  // The reference, an image and two maps, and thumbnails of the first two.
  EXPECT_EQ(count(outcome.dom, "measured=\"6 pictures, 0 broken\""), 1u) << outcome.dom.substr(0, 500);
}

TEST_F(HtmlReportInBrowser, nothing_sticks_out_of_a_wide_or_narrow_window) {
  for (const int width : {1200, 768, 390}) {
    const BrowserOutcome outcome =
        measure(width, "page.documentElement.scrollWidth <= page.documentElement.clientWidth ? 'fits' : 'overflows'");
    EXPECT_EQ(count(outcome.dom, "measured=\"fits\""), 1u) << width << ": " << outcome.dom.substr(0, 500);
  }
}

TEST_F(HtmlReportInBrowser, the_check_for_messages_sees_them) {
  std::ofstream(page) << "<!doctype html><script>console.error('seen')</script>";
  const BrowserOutcome outcome = browse(page);
  ASSERT_EQ(outcome.console.size(), 1u);
  EXPECT_NE(outcome.console[0].find("seen"), std::string::npos);
}

}  // namespace
}  // namespace photonproof
