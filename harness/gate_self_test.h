// What a suite's gates find, measured: every gate is run many times on engines with known faults and on healthy ones.
//
// An image costs a process, so runs share a pool of images a stream: each run takes an order of its pool and looks at
// the first `seeds`, twice as many and so on, never at one image twice. A pool of runs x seeds images has a first look
// for every run that no other has; of a smaller one each run takes a random order, runs are no more independent than
// the pool allows, and what they find is weighed as the disjoint ones it holds. A gate whose next look needs more
// images than there are stays inconclusive.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/gate_look.h"
#include "harness/gate_mutants.h"
#include "harness/gate_run.h"

namespace photonproof {

struct SelfTestOptions {
  GateOptions gates;             ///< `resume` uses images that an earlier self-test left
  std::filesystem::path faulty;  ///< the program with faults
  int runs = 100;                ///< a mutant; the null "other seeds" takes five times as many
  int pool = 64;                 ///< images of a healthy stream
  int other_pool = 16;           ///< of each variant that needs images of its own
  std::function<void(double fraction, const std::string& what)> progress{};
};

/// Of one gate on one variant.
struct VerdictCounts {
  int runs = 0, fail = 0, inconclusive = 0;
  int disjoint = 0;  ///< runs that share no image at their first look
};

struct SelfTest {
  std::vector<std::string> gates;
  std::vector<Variant> variants;
  std::vector<std::vector<VerdictCounts>> counts;  ///< by variant and gate; runs 0: not applicable
  std::vector<VerdictCounts> any;                  ///< by variant: at least one gate of the suite fails
  std::vector<double> alphas;                      ///< by gate
  int pool = 0, other_pool = 0, seeds = 0;
  bool interrupted = false;
};

/// Throws InputError as run_gates does, and when an engine does not render a healthy image.
SelfTest run_self_test(const GateSuite& suite, const SelfTestOptions& options);

/// Markdown: a row a gate, a column a variant, and what the whole suite finds.
std::string self_test_table(const GateSuite& suite, const SelfTest& test, const std::string& command);

/// Every mutant found in at least 99 of 100 runs by at least one gate, and no gate with more false alarms than its
/// alpha explains (95 %).
bool self_test_passes(const SelfTest& test);

}  // namespace photonproof
