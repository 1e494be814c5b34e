// One render of a sweep as a process, and what it is compared with, which many levels share.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "harness/stress/level_judge.h"
#include "harness/stress/sweep.h"
#include "harness/suites/engines.h"
#include "scenes/base/process.h"

namespace photonproof::inline harness_stress {

struct StressRender {
  std::string engine = "path";  ///< an integrator, or one of the others
  int spp = 64;
  std::uint64_t seed = 1;
};

/// Thrown when Ctrl-C ended a render: what it was for is not known.
struct StressInterrupted {};

/// Thrown where what a level is compared with ended in no picture and no error: `ending` is how.
struct ReferenceCrashed {
  std::string ending;
};

class StressRunner {
 public:
  /// References are kept in `folder`/references, by all they follow from; scenes for `others`, which must lie where the
  /// files are that they name, in `folder`/assets.
  StressRunner(std::filesystem::path program, std::filesystem::path folder, std::vector<Engine> others,
               const std::atomic<bool>* interrupt);

  /// The row of an engine that is no integrator; null of one that is.
  const Engine* other(const std::string& engine) const;

  LevelEvidence render(const StressScene& scene, const StressRender& how) const;
  /// Another verb of the program. Throws StressInterrupted.
  ProcessOutcome run(std::vector<std::string> arguments) const;
  /// The same as `render`, kept; throws InputError, with what the program says, where it is refused, else
  /// ReferenceCrashed where there is no picture.
  Rendering reference(const StressScene& scene, const StressRender& how);
  /// All that a render follows from, as text.
  std::string identity(const StressScene& scene, const StressRender& how) const;
  const std::string& checksum() const { return checksum_; }

 private:
  std::vector<std::string> command(const StressScene& scene, const StressRender& how, const std::string& file,
                                   const std::string& out) const;
  ProcessOutcome run_command(const std::vector<std::string>& command) const;

  std::filesystem::path program_, folder_;
  std::vector<Engine> others_;
  const std::atomic<bool>* interrupt_;
  std::string checksum_;
  std::mutex guard_;
  std::map<std::string, std::shared_ptr<std::mutex>> making_;
};

}  // namespace photonproof::inline harness_stress
