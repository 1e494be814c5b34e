// Measures what a suite's gates find. Every gate runs many times on engines with known faults, on edited images, with
// faults in this very process, and on healthy images.
//
// An image costs a process, so runs share a pool of images a stream. Each run takes an order of its pool. It looks at
// the first `seeds` images, then at twice as many and so on, never at one image twice. In a pool of runs x seeds images
// every run has a first look of its own. With a smaller pool each run takes a random order. Runs are then only as
// independent as the pool allows, and their results are weighed as the disjoint runs in it. A gate whose next look
// needs more images than there are stays inconclusive.
//
// A suite must find every fault that it shows. Images of a faulty engine have the seeds of sound ones. If those of a
// first look are bit-identical, the stream does not have the fault: nothing more is drawn or judged.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/gates/gate_look.h"
#include "harness/gates/gate_mutants.h"
#include "harness/gates/gate_run.h"
#include "harness/gates/pool_sizes.h"

namespace photonproof::inline harness_gates {

struct SelfTestOptions {
  GateOptions gates;             ///< `resume` uses images that an earlier self-test left.
  std::filesystem::path faulty;  ///< The program with faults.
  int runs = 100;                ///< Runs of a mutant; the null "other seeds" has five times as many.
  PoolSizes pool{64};            ///< Images of a healthy stream.
  PoolSizes other_pool{16};      ///< Images of each variant that draws its own.
  std::function<void(double fraction, const std::string& what)> progress{};
};

/// The verdicts of one gate on one variant.
struct VerdictCounts {
  int runs = 0, fail = 0, inconclusive = 0;
  int disjoint = 0;          ///< Runs that share no image at their first look.
  bool out_of_time = false;  ///< Not judged, runs 0: an image reached its limit of wall time, which proves nothing.
};

struct SelfTest {
  std::vector<std::string> gates;
  std::vector<GateVariant> variants;
  std::vector<std::vector<VerdictCounts>>
      counts;  ///< Results by variant and gate; 0 runs where the gate cannot have the variant.
  /// Runs in which at least one gate fails, by variant. Runs 0: no gate can have it, or none was judged.
  std::vector<VerdictCounts> any;
  std::vector<double> alphas;          ///< By gate.
  std::vector<int> pools;              ///< Healthy images, by gate.
  std::vector<Unpromised> unpromised;  ///< The suite's.
  int seeds = 0;                       ///< Images at a first look.
  bool interrupted = false;
};

/// Whether this program can plant the harness's faults in itself: only photonproof-faulty can.
bool can_plant_in_harness();

/// Throws InputError as run_gates does, and when an engine does not render a healthy image.
SelfTest run_self_test(const GateSuite& suite, const SelfTestOptions& options);

/// Markdown: a row a mutant, with the gates that find it, and a row a gate with its false alarms.
std::string self_test_table(const GateSuite& suite, const SelfTest& test, const std::string& command);

/// True if at least one gate finds every mutant in at least 99 of 100 runs. No gate may have more false alarms than its
/// alpha explains (95 %). Mutants that change no image of the suite, or are among its `unpromised`, do not count. A
/// mutant of which only a time limit is known is not found.
bool self_test_passes(const SelfTest& test);

}  // namespace photonproof::inline harness_gates
