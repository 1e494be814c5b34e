// The result of a self-test as a table for readers, who choose thresholds from it.

#include <fmt/ranges.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "harness/gates/gate_self_tests.h"

namespace photonproof::inline harness_gates {
namespace {

constexpr double confidence = 0.95;
constexpr double least_found = 0.99;

std::string percent(int part, int whole) { return whole == 0 ? "–" : fmt::format("{:.3g}", 100.0 * part / whole); }
std::string percent(const VerdictCounts& counts) { return percent(counts.fail, counts.runs); }

/// The most false alarms that a rate of `alpha` explains.
int most_alarms(int runs, double alpha) {
  return static_cast<int>(boost::math::quantile(boost::math::binomial(runs, alpha), confidence));
}

/// The sum of all nulls of one gate, each weighed by the number of disjoint runs in it.
VerdictCounts nulls_of(const SelfTest& test, std::size_t gate) {
  VerdictCounts sum;
  double fail = 0, inconclusive = 0;
  for (std::size_t v = 0; v < test.variants.size(); ++v) {
    const VerdictCounts& counts = test.counts[v][gate];
    if (test.variants[v].is_mutant() || counts.runs == 0) continue;
    const double weight = static_cast<double>(counts.disjoint) / counts.runs;
    sum.runs += counts.disjoint;
    fail += weight * counts.fail;
    inconclusive += weight * counts.inconclusive;
  }
  sum.fail = static_cast<int>(std::lround(fail));
  sum.inconclusive = static_cast<int>(std::lround(inconclusive));
  return sum;
}

bool too_many_alarms(const SelfTest& test, std::size_t gate) {
  const VerdictCounts nulls = nulls_of(test, gate);
  return nulls.fail > most_alarms(nulls.runs, test.alphas[gate]);
}

bool is_found(const VerdictCounts& any) {
  return any.fail >= least_found * any.runs && !(any.runs == 0 && any.out_of_time);
}

/// Mutants that the suite does not find, and that are not among its `unpromised`.
std::vector<std::string> missed(const SelfTest& test) {
  std::vector<std::string> names;
  for (std::size_t v = 0; v < test.variants.size(); ++v) {
    const std::string& name = test.variants[v].name;
    const bool unpromised = std::any_of(test.unpromised.begin(), test.unpromised.end(),
                                        [&](const Unpromised& row) { return row.planted == name; });
    if (test.variants[v].is_mutant() && !unpromised && !is_found(test.any[v])) names.push_back(name);
  }
  return names;
}

/// "path/agreement": the kind of gates that a suite names by their scene.
std::string kind_of(const Gate& gate) { return gate.engine + "/" + gate.metric; }

/// The gates that find a mutant, grouped by kind: "all 9 path/agreement; photonmapper/ssim: cornell, forms 41".
std::string finders(const GateSuite& suite, const SelfTest& test, std::size_t variant) {
  struct Kind {
    std::string name;
    std::size_t gates = 0, always = 0;
    std::vector<std::string> found{};
  };
  std::vector<Kind> kinds;
  for (std::size_t g = 0; g < test.gates.size(); ++g) {
    const auto gate = std::find_if(suite.gates.begin(), suite.gates.end(),
                                   [&](const Gate& one) { return one.name == test.gates[g]; });
    auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& one) { return one.name == kind_of(*gate); });
    if (kind == kinds.end()) kind = kinds.insert(kind, {kind_of(*gate)});
    ++kind->gates;
    const VerdictCounts& counts = test.counts[variant][g];
    if (counts.fail == 0) continue;
    if (counts.fail == counts.runs) ++kind->always;
    const bool usual_name = gate->name == gate->scene + "/" + kind->name;
    kind->found.push_back((usual_name ? gate->scene : gate->name) +
                          (counts.fail == counts.runs ? "" : " " + percent(counts)));
  }
  std::vector<std::string> texts;
  for (const Kind& kind : kinds) {
    if (kind.found.empty()) continue;
    texts.push_back(kind.always == kind.gates && kind.gates > 1
                        ? fmt::format("all {} {}", kind.gates, kind.name)
                        : fmt::format("{}: {}", kind.name, fmt::join(kind.found, ", ")));
  }
  return texts.empty() ? "–" : fmt::format("{}", fmt::join(texts, "; "));
}

struct Section {
  const char* title;
  std::vector<PlantedIn> planted;
};

std::string mutants_table(const GateSuite& suite, const SelfTest& test, const Section& section) {
  std::string rows;
  for (std::size_t v = 0; v < test.variants.size(); ++v) {
    const GateVariant& variant = test.variants[v];
    if (std::find(section.planted.begin(), section.planted.end(), variant.planted) == section.planted.end()) continue;
    if (test.any[v].runs == 0) continue;
    rows += fmt::format("| **{}**: {} | {} | {} |\n", variant.name, variant.what, percent(test.any[v]),
                        finders(suite, test, v));
  }
  if (rows.empty()) return "";
  return fmt::format(
      "## {}\n\n| planted | at least one gate | found by (in % of runs where not always) |\n|---|--:|---|\n{}\n",
      section.title, rows);
}

std::string nulls_table(const SelfTest& test) {
  std::vector<std::size_t> nulls;
  for (std::size_t v = 0; v < test.variants.size(); ++v)
    if (!test.variants[v].is_mutant() && test.any[v].runs > 0) nulls.push_back(v);
  std::string text = "## False alarms\n\n| gate | images |", rule = "|---|--:|";
  for (const std::size_t v : nulls) {
    text += " " + test.variants[v].name + " |";
    rule += "--:|";
  }
  text += " inconclusive | alarms of disjoint runs | most that alpha explains |\n" + rule + "--:|--:|--:|\n";
  for (std::size_t g = 0; g < test.gates.size(); ++g) {
    text += fmt::format("| {} | {} |", test.gates[g], test.pools[g]);
    for (const std::size_t v : nulls) text += " " + percent(test.counts[v][g]) + " |";
    const VerdictCounts all = nulls_of(test, g);
    text += fmt::format(" {} | {} of {} | {}{} |\n", percent(all.inconclusive, all.runs), all.fail, all.runs,
                        most_alarms(all.runs, test.alphas[g]), too_many_alarms(test, g) ? " **too many**" : "");
  }
  text += "| **at least one gate** | |";
  for (const std::size_t v : nulls) text += " **" + percent(test.any[v]) + "** |";
  return text + " | | |\n\n";
}

/// The gates whose images reached their time limit.
std::vector<std::string> not_judging(const SelfTest& test, std::size_t variant) {
  std::vector<std::string> names;
  for (std::size_t g = 0; g < test.gates.size(); ++g)
    if (test.counts[variant][g].out_of_time) names.push_back(test.gates[g]);
  return names;
}

std::string conclusion(const SelfTest& test) {
  std::vector<std::string> unseen;
  for (std::size_t v = 0; v < test.variants.size(); ++v)
    if (test.variants[v].is_mutant() && test.any[v].runs == 0 && !test.any[v].out_of_time)
      unseen.push_back(test.variants[v].name);
  std::string text;
  if (!unseen.empty())
    text += fmt::format("These faults change no image of this suite: {}.\n\n", fmt::join(unseen, ", "));
  for (std::size_t v = 0; v < test.variants.size(); ++v)
    if (test.any[v].out_of_time)
      text += fmt::format("{} ran into a limit of wall time and was not judged by: {}.\n\n", test.variants[v].name,
                          fmt::join(not_judging(test, v), ", "));
  for (const Unpromised& row : test.unpromised)
    for (std::size_t v = 0; v < test.variants.size(); ++v)
      if (test.variants[v].name == row.planted && test.any[v].runs > 0)
        text += fmt::format("The suite does not promise to find {}, found in {} % of the runs: {}.\n\n", row.planted,
                            percent(test.any[v]), row.why);
  if (const std::vector<std::string> names = missed(test); !names.empty())
    text += fmt::format("Not found in 99 of 100 runs: {}.\n", fmt::join(names, ", "));
  if (self_test_passes(test))
    text +=
        "Every other fault that changes an image of this suite is found in at least 99 of 100 runs. No gate has more "
        "false alarms than its alpha explains (95 %).\n";
  return text;
}

}  // namespace

bool self_test_passes(const SelfTest& test) {
  if (!missed(test).empty()) return false;
  for (std::size_t g = 0; g < test.gates.size(); ++g)
    if (too_many_alarms(test, g)) return false;
  return true;
}

std::string self_test_table(const GateSuite& suite, const SelfTest& test, const std::string& command) {
  std::string text = fmt::format("# What the gates of `{}` find\n\n```sh\n{}\n```\n\n", suite.name, command);
  text += fmt::format(
      "Percentages count the runs in which a gate fails: with a planted fault it is found, without one it is a false "
      "alarm. A run's first look takes {} images from a pool. Runs are disjoint when the pool has {} times as many "
      "images as there are runs. In a smaller pool runs share images, and false alarms count as those of the disjoint "
      "runs. Each fault of the renderer and of the harness is one condition in the source (scenes/base/faults.h).\n\n",
      test.seeds, test.seeds);
  for (const Section& section : {Section{"In the renderer", {PlantedIn::renderer}},
                                 Section{"In the harness", {PlantedIn::drawing, PlantedIn::judging}},
                                 Section{"In the image", {PlantedIn::image}}})
    text += mutants_table(suite, test, section);
  return text + nulls_table(test) + conclusion(test);
}

}  // namespace photonproof::inline harness_gates
