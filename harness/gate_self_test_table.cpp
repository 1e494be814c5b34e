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

/// All nulls of one gate together.
VerdictCounts nulls_of(const SelfTest& test, std::size_t gate) {
  VerdictCounts sum;
  for (std::size_t v = 0; v < test.variants.size(); ++v) {
    if (test.variants[v].is_mutant) continue;
    sum.runs += test.counts[v][gate].runs;
    sum.fail += test.counts[v][gate].fail;
    sum.inconclusive += test.counts[v][gate].inconclusive;
  }
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
  text += fmt::format(
      "Runs in which a gate fails, in per cent: detections of what was planted, and under the nulls false alarms. "
      "Runs share images: {} healthy ones a scene, engine and budget, of which the first look takes {} ({} disjoint "
      "draws), and {} of each variant that needs images of its own.\n\n",
      test.pool, test.seeds, test.pool / std::max(1, test.seeds), test.other_pool);
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
    text += fmt::format(" {:.3g} | {} of {}, {}{} |\n",
                        nulls.runs > 0 ? 100.0 * nulls.inconclusive / nulls.runs : 0.0, nulls.fail, nulls.runs,
                        most_alarms(nulls.runs, test.alphas[g]), too_many_alarms(test, g) ? " **too many**" : "");
  }
  text += "| **at least one gate** |";
  for (const VerdictCounts& any : test.any) text += " **" + percent(any) + "** |";
  text += " | |\n\n";
  for (std::size_t v = 0; v < test.variants.size(); ++v)
    if (test.variants[v].is_mutant && !is_found(test.any[v]))
      text += fmt::format("Not found in 99 of 100 runs: {}.\n", test.variants[v].name);
  if (self_test_passes(test))
    text += "Every mutant is found in at least 99 of 100 runs, and no gate has more false alarms than its alpha "
            "explains (95 %).\n";
  return text;
}

}  // namespace photonproof
