// One render of a sweep as a process, and the picture that it is compared with, which many levels share.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "harness/images/image_source.h"
#include "harness/stress/level_judge.h"
#include "harness/stress/sweep.h"
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
  /// Keeps references in `folder`/cells (harness/images/image_store.h). Scenes for `others` are in `folder`/assets,
  /// beside the files that they name.
  StressRunner(std::filesystem::path program, std::filesystem::path folder, std::vector<Engine> others,
               const std::atomic<bool>* interrupt);

  /// The row of an engine that is not an integrator; null for an integrator.
  const Engine* other(const std::string& engine) const;

  LevelEvidence render(const StressScene& scene, const StressRender& how) { return draw(scene, how, false); }
  /// Another verb of the program. Throws StressInterrupted.
  ProcessOutcome run(std::vector<std::string> arguments) const;
  /// Like `render`, but kept. Throws InputError with the program's message where it refuses the scene, else
  /// ReferenceCrashed where there is no picture.
  Rendering reference(const StressScene& scene, const StressRender& how);
  /// The key of a render's image (harness/images/image_source.h).
  std::string key(const StressScene& scene, const StressRender& how) const;
  const std::string& checksum() const { return checksum_; }

 private:
  LevelEvidence draw(const StressScene& scene, const StressRender& how, bool is_kept);
  ImageSourceOptions options(const std::filesystem::path& folder) const;

  std::filesystem::path program_, folder_;
  std::vector<Engine> others_;
  const std::atomic<bool>* interrupt_;
  std::string checksum_;
  ImageSource references_;
};

}  // namespace photonproof::inline harness_stress
