// Runs the gates of a suite: draws images, looks, decides, and writes the record.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <string>

#include "harness/gates/gate_images.h"
#include "harness/gates/gate_suite.h"
#include "reference/store/reference_store.h"

namespace photonproof::inline harness_gates {

struct GateOptions {
  std::filesystem::path folder;   ///< Receives results.json, gates/ with pictures and cells/ with the images.
  std::filesystem::path program;  ///< This program.
  std::string command;            ///< Repeats the run.
  std::map<std::string, std::string> versions;
  std::uint64_t seed = 1;  ///< The same build, suite and seed give the same verdicts.
  std::string only;        ///< Gates whose name contains this.
  bool resume = false;     ///< Use the images that an earlier run left in `folder`.
  bool fresh = false;      ///< Judge every gate, even if an accepted verdict has the same images.
  const std::atomic<bool>* interrupt = nullptr;
};

class GateObserver {
 public:
  virtual ~GateObserver() = default;
  /// Progress of the images that all gates need for their first look. Called from one thread at a time.
  virtual void draws(std::size_t drawn, std::size_t total) = 0;
  virtual void looks(std::size_t number, std::size_t total, const Gate& gate, std::size_t images) = 0;
  virtual void ended(std::size_t number, std::size_t total, const GateRecord& record) = 0;
};

struct GateSummary {
  std::filesystem::path results_file;
  Results results;  ///< As written.
  bool interrupted = false;
  std::size_t count(GateVerdict verdict) const;
  std::size_t accepted() const;  ///< Passes that an earlier run decided (accepted_verdicts.h).
};

/// Throws InputError before drawing for a suite or reference that cannot be used. Failures of an engine are verdicts.
GateSummary run_gates(const GateSuite& suite, const GateOptions& options, GateObserver& observer);

}  // namespace photonproof::inline harness_gates
