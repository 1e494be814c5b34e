// One render of a ladder as a process, and what it is compared with, which many rungs share.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "harness/stress/ladder.h"
#include "harness/stress/rung_judge.h"
#include "reference/process/process.h"

namespace photonproof {

struct StressRender {
  std::string engine = "path";
  int spp = 64;
  std::uint64_t seed = 1;
};

/// Thrown when Ctrl-C ended a render: what it was for is not known.
struct StressInterrupted {};

class StressRunner {
 public:
  /// References are kept in `folder`, by all they follow from.
  StressRunner(std::filesystem::path program, std::filesystem::path folder, const std::atomic<bool>* interrupt);

  RungEvidence render(const StressScene& scene, const StressRender& how) const;
  /// Another verb of the program. Throws StressInterrupted.
  ProcessOutcome run(std::vector<std::string> arguments) const;
  /// The same as `render`, kept; throws InputError, with what the program says, where there is no picture.
  Rendering reference(const StressScene& scene, const StressRender& how);
  /// All that a render follows from, as text.
  std::string identity(const StressScene& scene, const StressRender& how) const;
  const std::string& checksum() const { return checksum_; }

 private:
  std::vector<std::string> command(const StressScene& scene, const StressRender& how, const std::string& file,
                                   const std::string& out) const;

  std::filesystem::path program_, folder_;
  const std::atomic<bool>* interrupt_;
  std::string checksum_;
  std::mutex guard_;
  std::map<std::string, std::shared_ptr<std::mutex>> making_;
};

}  // namespace photonproof
