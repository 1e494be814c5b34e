// A testcase's outcome is an element with its sentence. A gate whose images fail and a regression are a `failure`. A
// cell that did not finish, and a gate whose engine crashed, hung or could not start, are an `error`. An open result
// (an inconclusive gate or change, an unsupported cell) is `skipped`. The schema has properties on testsuites only, so
// metrics carry the name of their testcase: "case: metric".
#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

#include "reports/formats/exchange_reports.h"
#include "reports/view/text.h"
#include "reports/view/view.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_formats {
using namespace reports;

namespace {

struct Tally {
  int tests = 0, failures = 0, errors = 0, skipped = 0;
  double seconds = 0;
};

/// The schema's time has no exponent.
std::string seconds_text(double seconds) { return fmt::format("{:.3f}", seconds); }

class Suite {
 public:
  Suite(pugi::xml_node parent, const std::string& name) : node_(parent.append_child("testsuite")) {
    node_.append_attribute("name") = printable(name).c_str();
    for (const char* total : {"tests", "failures", "errors", "skipped", "time"}) node_.append_attribute(total);
    properties_ = node_.append_child("properties");
  }

  void add_property(const std::string& name, const std::string& value) {
    pugi::xml_node property = properties_.append_child("property");
    property.append_attribute("name") = printable(name).c_str();
    property.append_attribute("value") = printable(value).c_str();
  }
  void add_number(const std::string& name, const std::string& quantity, const std::optional<Estimate>& estimate) {
    if (!estimate) return;
    add_property(name + ": " + quantity, fmt::format("{}", estimate->value));
    if (!estimate->interval) return;
    add_property(name + ": " + quantity + " low", fmt::format("{}", estimate->interval->low));
    add_property(name + ": " + quantity + " high", fmt::format("{}", estimate->interval->high));
  }

  /// `outcome` is the name of the outcome's element, empty for a pass.
  void add_case(const std::string& name, const std::string& classname, double seconds, const char* outcome,
                const std::string& type, const std::string& sentence, const std::string& output) {
    pugi::xml_node test = node_.append_child("testcase");
    test.append_attribute("name") = printable(name).c_str();
    test.append_attribute("classname") = printable(classname).c_str();
    test.append_attribute("time") = seconds_text(seconds).c_str();
    ++tally.tests;
    tally.seconds += seconds;
    if (const std::string_view what = outcome; !what.empty()) {
      ++(what == "failure" ? tally.failures : what == "error" ? tally.errors : tally.skipped);
      pugi::xml_node node = test.append_child(outcome);
      node.append_attribute("type") = type.c_str();
      node.append_attribute("message") = printable(sentence).c_str();
    }
    if (!output.empty()) test.append_child("system-out").text() = output.c_str();
  }

  void finish() {
    node_.attribute("tests") = tally.tests;
    node_.attribute("failures") = tally.failures;
    node_.attribute("errors") = tally.errors;
    node_.attribute("skipped") = tally.skipped;
    node_.attribute("time") = seconds_text(tally.seconds).c_str();
    if (!properties_.first_child()) node_.remove_child(properties_);
  }

  Tally tally;

 private:
  pugi::xml_node node_, properties_;
};

void add_gate_case(Suite& suite, const GateRecord& gate) {
  const bool no_images = gate.status && *gate.status != Status::bad_image;  // a bad image is a wrong image
  const char* outcome = gate.verdict == GateVerdict::fail && no_images ? "error"
                        : gate.verdict == GateVerdict::fail            ? "failure"
                        : gate.verdict == GateVerdict::inconclusive    ? "skipped"
                                                                       : "";
  std::string output = printable(gate.sentence) + "\n";
  for (const FailingTile& tile : gate.tiles) {
    output += fmt::format("tile {},{} {}x{}: {}\n", tile.x, tile.y, tile.width, tile.height, printable(tile.sentence));
  }
  if (!gate.command.empty()) output += "repeat with: " + printable(gate.command) + "\n";
  suite.add_number(gate.name, gate.metric, gate.observed);
  if (gate.bound) suite.add_number(gate.name, "bound", Estimate{*gate.bound, {}});
  if (gate.would_see) suite.add_number(gate.name, "would see", Estimate{*gate.would_see, {}});
  if (gate.would_see_in_a_block)
    suite.add_number(gate.name, "would see in a block", Estimate{*gate.would_see_in_a_block, {}});
  if (!gate.regression_only.empty()) suite.add_property(gate.name + ": regression only", gate.regression_only);
  suite.add_number(gate.name, "alpha", Estimate{gate.alpha, {}});
  suite.add_number(gate.name, "samples", Estimate{static_cast<double>(gate.samples), {}});
  suite.add_case(gate.name, gate.scene + "." + gate.engine, gate.seconds, outcome,
                 gate.status ? to_string(*gate.status) : to_string(gate.verdict), gate.sentence, output);
}

void add_change(Suite& suite, const ChangeRecord& change) {
  const char* outcome = change.change == Change::regression     ? "failure"
                        : change.change == Change::inconclusive ? "skipped"
                                                                : "";
  const std::string name = fmt::format("{} {} against the old run", change.quantity, change.budget.label());
  suite.add_number(change.engine + " " + name, "ratio", change.ratio);
  suite.add_case(name, change.scene + "." + change.engine, 0, outcome, to_string(change.change), change.sentence, "");
}

void add_cell_case(Suite& suite, const Result& result) {
  const char* outcome = result.status == Status::ok ? "" : result.status == Status::unsupported ? "skipped" : "error";
  const std::string name = fmt::format("{} seed {}", result.cell.budget.label(), result.cell.seed);
  for (const MetricValue& metric : result.metrics) {
    suite.add_number(result.cell.engine + " " + name, metric.name, Estimate{metric.value, {}});
  }
  suite.add_case(name, result.cell.scene + "." + result.cell.engine, result.wall_seconds.value_or(0), outcome,
                 to_string(result.status), result.detail,
                 result.command.empty() ? "" : "repeat with: " + printable(result.command) + "\n");
}

}  // namespace

void write_junit_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out) {
  const View view = arrange(results);
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("testsuites");
  root.append_attribute("name") = printable(results.suite).c_str();
  Tally total;
  for (const SceneView& scene : view.scenes) {
    Suite suite(root, scene.record.name);
    for (const GateRecord* gate : scene.gates) add_gate_case(suite, *gate);
    for (const ChangeRecord* change : view.changes) {
      if (change->scene == scene.record.name) add_change(suite, *change);
    }
    for (const EngineOutcome& outcome : scene.engines) {
      for (const Result* cell : outcome.cells) add_cell_case(suite, *cell);
    }
    suite.finish();
    total.tests += suite.tally.tests;
    total.failures += suite.tally.failures;
    total.errors += suite.tally.errors;
    total.seconds += suite.tally.seconds;
  }
  root.append_attribute("tests") = total.tests;
  root.append_attribute("failures") = total.failures;
  root.append_attribute("errors") = total.errors;
  root.append_attribute("time") = seconds_text(total.seconds).c_str();
  std::ostringstream text;
  document.save(text, "  ");
  write_file_atomically(out, text.str());
}

}  // namespace photonproof::inline reports_formats
