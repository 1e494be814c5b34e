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
  std::filesystem::path folder;   ///< receives results.json, gates/ with pictures and cells/ with the images
  std::filesystem::path program;  ///< this program
  std::string command;            ///< how the run is repeated
  std::map<std::string, std::string> versions;
  std::uint64_t seed = 1;  ///< the same build, suite and seed give the same verdicts
  std::string only;        ///< gates whose name contains this
  bool resume = false;     ///< use the images that an earlier run left in `folder`
  bool fresh = false;      ///< judge every gate, also where an accepted verdict is of the same images
  const std::atomic<bool>* interrupt = nullptr;
};

class GateObserver {
 public:
  virtual ~GateObserver() = default;
  /// Of the images that all gates need for their first look. From one thread at a time.
  virtual void draws(std::size_t drawn, std::size_t total) = 0;
  virtual void looks(std::size_t number, std::size_t total, const Gate& gate, std::size_t images) = 0;
  virtual void ended(std::size_t number, std::size_t total, const GateRecord& record) = 0;
};

struct GateSummary {
  std::filesystem::path results_file;
  Results results;  ///< as written
  bool interrupted = false;
  std::size_t count(GateVerdict verdict) const;
  std::size_t accepted() const;  ///< passes that an earlier run decided (accepted_verdicts.h)
};

/// Throws InputError for a suite or reference that cannot be used, before anything is drawn. Whatever an engine does is
/// a verdict.
GateSummary run_gates(const GateSuite& suite, const GateOptions& options, GateObserver& observer);

}  // namespace photonproof::inline harness_gates
