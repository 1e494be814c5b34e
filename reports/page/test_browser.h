// Loads a page in headless Chromium, for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reports/view/test_sample_results.h"
#include "scenes/base/process.h"

namespace photonproof::reports::inline reports_page {

struct BrowserOutcome {
  std::string dom;
  std::vector<std::string> console;  ///< one line per message
};

/// Loads a file and returns its document. Fails the test if there is no Chromium; ./check installs it.
inline BrowserOutcome browse(const std::filesystem::path& page) {
  const TemporaryFolder profile;
  ProcessOptions options;
  options.wall_limit_seconds = 110;
  const ProcessOutcome outcome = run_process(
      {"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
       "--disable-background-networking", "--disable-component-update", "--disable-sync", "--window-size=1300,1000",
       "--force-prefers-reduced-motion", "--user-data-dir=" + profile.path().string(), "--enable-logging=stderr",
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

/// Shows the page in a frame `width` pixels wide and drives it by `steps`. These are the body of an async JavaScript
/// function of the frame's (page, window) and return what it observed. It may also call `wait(ms)`, `drawn()`,
/// `until(condition)`, `key(target, key, more)` and `pointer(target, type, x, y, more)`, which dispatch a user's
/// events.
inline nlohmann::json drive(const std::filesystem::path& page, int width, const std::string& steps,
                            std::vector<std::string>* console = nullptr) {
  std::string framed;
  for (const char c : file_text(page)) framed += c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  const std::filesystem::path wrapper = page.parent_path() / "wrapper.html";
  // The page forbids every script except its own, so the wrapper's script reads it from outside.
  std::ofstream(wrapper)
      << "<!doctype html><title>wrapper</title><link rel=icon href='data:,'><iframe "
         "id=hold></iframe><script>hold.contentDocument.open();</script><iframe id=frame style='width:"
      << width << "px;height:900px;border:0' srcdoc=\"" << framed << "\"></iframe><script>"
      << R"(
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const until = async (condition) => { for (let i = 0; i < 100 && !condition(); ++i) await wait(50); return condition(); };
const frame = document.getElementById("frame");
// Two frames: what an event asked for is drawn in the first.
const drawn = () => new Promise((done) => {
  const {requestAnimationFrame} = frame.contentWindow;
  requestAnimationFrame(() => requestAnimationFrame(done));
});
const key = async (target, key, more = {}) => {
  target.dispatchEvent(new frame.contentWindow.KeyboardEvent("keydown", {key, bubbles: true, cancelable: true, ...more}));
  await drawn();
};
const pointer = async (target, type, x, y, more = {}) => {
  const make = type === "wheel" ? frame.contentWindow.WheelEvent : frame.contentWindow.PointerEvent;
  target.dispatchEvent(new make(type, {clientX: x, clientY: y, button: 0, pointerId: 1, bubbles: true, cancelable: true, ...more}));
  await drawn();
};
const drive = async (page, window) => {)"
      << steps << R"(};
frame.onload = async () => {
  let observed;
  try { observed = await drive(frame.contentDocument, frame.contentWindow); } catch (error) { observed = {thrown: String(error.stack)}; }
  document.documentElement.setAttribute("observed", btoa(unescape(encodeURIComponent(JSON.stringify(observed)))));
  frame.remove();
  hold.contentDocument.close();
};</script>)";
  const BrowserOutcome outcome = browse(wrapper);
  if (console) *console = outcome.console;
  const std::size_t from = outcome.dom.find("observed=\"");
  if (from == std::string::npos) {
    ADD_FAILURE() << "the steps did not come to their end\n" << outcome.dom.substr(0, 500);
    return {};
  }
  const std::size_t begin = from + 10;
  const std::string encoded = outcome.dom.substr(begin, outcome.dom.find('"', begin) - begin);
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  unsigned bits = 0, held = 0;
  for (const char c : encoded) {
    if (c == '=') break;
    held = held << 6 | static_cast<unsigned>(alphabet.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    text += static_cast<char>(held >> bits & 0xFF);
  }
  return nlohmann::json::parse(text);
}

}  // namespace photonproof::reports::inline reports_page
