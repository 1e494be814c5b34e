// What a self-test found, as a table for people: thresholds are chosen from it.

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "harness/gate_self_test.h"

namespace photonproof {
namespace {

constexpr double confidence = 0.95;
constexpr double least_found = 0.99;

std::string percent(const VerdictCounts& counts) {
  if (counts.runs == 0) return "–";
  return fmt::format("{:.3g}", 100.0 * counts.fail / counts.runs);
}

/// The most false alarms that a rate of `alpha` explains.
int most_alarms(int runs, double alpha) {
  return static_cast<int>(boost::math::quantile(boost::math::binomial(runs, alpha), confidence));
}

/// All nulls of one gate together, each weighed as the disjoint runs it holds.
VerdictCounts nulls_of(const SelfTest& test, std::size_t gate) {
  VerdictCounts sum;
  double fail = 0, inconclusive = 0;
  for (std::size_t v = 0; v < test.variants.size(); ++v) {
    const VerdictCounts& counts = test.counts[v][gate];
    if (test.variants[v].is_mutant || counts.runs == 0) continue;
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

bool is_found(const VerdictCounts& any) { return any.fail >= least_found * any.runs; }

}  // namespace

bool self_test_passes(const SelfTest& test) {
  for (std::size_t v = 0; v < test.variants.size(); ++v)
    if (test.variants[v].is_mutant && !is_found(test.any[v])) return false;
  for (std::size_t g = 0; g < test.gates.size(); ++g)
    if (too_many_alarms(test, g)) return false;
  return true;
}

std::string self_test_table(const GateSuite& suite, const SelfTest& test, const std::string& command) {
  std::string text = fmt::format("# What the gates of `{}` find\n\n", suite.name);
  text += fmt::format("`{}`\n\n", command);
  const int disjoint = test.pool / std::max(1, test.seeds), other_disjoint = test.other_pool / std::max(1, test.seeds);
  text += fmt::format(
      "Runs in which a gate fails, in per cent: detections of what was planted, and under the nulls false alarms. "
      "{} healthy images a scene, engine and budget, {} of each variant that needs images of its own; a first look "
      "takes {}, so that {} and {} runs share none. The last column weighs nulls as such disjoint runs.\n\n",
      test.pool, test.other_pool, test.seeds, disjoint, other_disjoint);
  std::string rule = "|---|";
  text += "| gate |";
  for (const Variant& variant : test.variants) {
    text += " " + variant.name + (variant.is_mutant ? "" : " (null)") + " |";
    rule += "--:|";
  }
  text += " nulls inconclusive | alarms in nulls, most that alpha explains |\n" + rule + "--:|--:|\n";
  for (std::size_t g = 0; g < test.gates.size(); ++g) {
    text += "| " + test.gates[g] + " |";
    for (std::size_t v = 0; v < test.variants.size(); ++v) text += " " + percent(test.counts[v][g]) + " |";
    const VerdictCounts nulls = nulls_of(test, g);
    text += fmt::format(" {:.3g} | {} of {}, {}{} |\n", nulls.runs > 0 ? 100.0 * nulls.inconclusive / nulls.runs : 0.0,
                        nulls.fail, nulls.runs, most_alarms(nulls.runs, test.alphas[g]),
                        too_many_alarms(test, g) ? " **too many**" : "");
  }
  text += "| **at least one gate** |";
  for (const VerdictCounts& any : test.any) text += " **" + percent(any) + "** |";
  text += " | |\n\n";
  for (std::size_t v = 0; v < test.variants.size(); ++v)
    if (test.variants[v].is_mutant && !is_found(test.any[v]))
      text += fmt::format("Not found in 99 of 100 runs: {}.\n", test.variants[v].name);
  if (self_test_passes(test))
    text +=
        "Every mutant is found in at least 99 of 100 runs, and no gate has more false alarms than its alpha "
        "explains (95 %).\n";
  return text;
}

}  // namespace photonproof
