// What a suite's gates find, measured: every gate is run many times on engines with known faults, on images that were
// edited, with faults in this very process, and on healthy ones.
//
// An image costs a process, so runs share a pool of images a stream: each run takes an order of its pool and looks at
// the first `seeds`, twice as many and so on, never at one image twice. A pool of runs x seeds images has a first look
// for every run that no other has; of a smaller one each run takes a random order, runs are no more independent than
// the pool allows, and what they find is weighed as the disjoint ones it holds. A gate whose next look needs more
// images than there are stays inconclusive.
//
// A suite has to find what it shows. Images of an engine with a fault have the seeds of sound ones: where those of a
// first look are the same to the bit, the stream does not have the fault, and no more is drawn or judged.
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
  GateOptions gates;             ///< `resume` uses images that an earlier self-test left
  std::filesystem::path faulty;  ///< the program with faults
  int runs = 100;                ///< a mutant; the null "other seeds" takes five times as many
  PoolSizes pool{64};            ///< images of a healthy stream
  PoolSizes other_pool{16};      ///< of each variant that needs images of its own
  std::function<void(double fraction, const std::string& what)> progress{};
};

/// Of one gate on one variant.
struct VerdictCounts {
  int runs = 0, fail = 0, inconclusive = 0;
  int disjoint = 0;          ///< runs that share no image at their first look
  bool out_of_time = false;  ///< not judged, runs 0: an image ran into its limit of wall time, which proves nothing
};

struct SelfTest {
  std::vector<std::string> gates;
  std::vector<GateVariant> variants;
  std::vector<std::vector<VerdictCounts>> counts;  ///< by variant and gate; runs 0: it cannot have it
  /// By variant: at least one gate of the suite fails; runs 0: none can have it, or none was judged.
  std::vector<VerdictCounts> any;
  std::vector<double> alphas;          ///< by gate
  std::vector<int> pools;              ///< healthy images, by gate
  std::vector<Unpromised> unpromised;  ///< the suite's
  int seeds = 0;                       ///< at a first look
  bool interrupted = false;
};

/// Whether this program can plant the harness's faults in itself: photonproof-faulty. Elsewhere no gate can have them.
bool can_plant_in_harness();

/// Throws InputError as run_gates does, and when an engine does not render a healthy image.
SelfTest run_self_test(const GateSuite& suite, const SelfTestOptions& options);

/// Markdown: a row a mutant, with the gates that find it, and a row a gate with its false alarms.
std::string self_test_table(const GateSuite& suite, const SelfTest& test, const std::string& command);

/// Every mutant that changes an image of the suite, and is not among its `unpromised`, found in at least 99 of 100 runs
/// by at least one gate, and no gate with more false alarms than its alpha explains (95 %). A mutant of which nothing
/// is known but that it was slow is not found.
bool self_test_passes(const SelfTest& test);

}  // namespace photonproof::inline harness_gates
