// One render of a sweep as a process, and the picture that it is compared with, which many levels share.
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
  std::string engine = "path";  ///< An integrator, or one of the other engines.
  int spp = 64;
  std::uint64_t seed = 1;
};

/// Thrown when Ctrl-C ends a render: its result is unknown.
struct StressInterrupted {};

/// Thrown where the render of a reference gives neither a picture nor an error; `ending` is the end of its process.
struct ReferenceCrashed {
  std::string ending;
};

class StressRunner {
 public:
  /// Keeps references in `folder`/references, by all their inputs. Scenes for `others` are in `folder`/assets, beside
  /// the files that they name.
  StressRunner(std::filesystem::path program, std::filesystem::path folder, std::vector<Engine> others,
               const std::atomic<bool>* interrupt);

  /// The row of an engine that is not an integrator; null for an integrator.
  const Engine* other(const std::string& engine) const;

  LevelEvidence render(const StressScene& scene, const StressRender& how) const;
  /// Another verb of the program. Throws StressInterrupted.
  ProcessOutcome run(std::vector<std::string> arguments) const;
  /// Like `render`, but kept. Throws InputError with the program's message where it refuses the scene, else
  /// ReferenceCrashed where there is no picture.
  Rendering reference(const StressScene& scene, const StressRender& how);
  /// All inputs of a render, as text.
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
