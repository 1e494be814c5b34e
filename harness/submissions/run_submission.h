// Runs a built submission once, in the sandbox, and reads its image.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/submissions/build_submission.h"
#include "harness/submissions/image_declaration.h"
#include "harness/submissions/submission.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_submissions {

/// Name of a scene file in our format, in its folder.
inline constexpr const char* scene_file_name = "scene.xml";

struct RunRecipe {
  /// May contain {names} of `values`, {output} and {params}, which are relative to the command's starting folder, and
  /// {scene}.
  std::vector<std::string> command{};
  std::vector<std::string> command_before{};  ///< if not empty, runs first in the same place, which it may change
  bool leaves_image_before = false;           ///< its image remains in the folder for temporary files
  std::map<std::string, std::string> values{};
  std::string params{};                  ///< text of the scene's own file; written to `params_place` unless empty
  std::string params_place{};            ///< relative, within the run's folder
  std::filesystem::path scene_folder{};  ///< read-only for the command, which {scene} leads to; empty: none
  std::map<std::string, std::string> environment{};
  SandboxLimits limits{};
};

struct RunOutcome {
  enum class Kind {
    ok,
    not_started,
    crash,  ///< a signal, or an exit code other than 0
    timeout,
    memory,
    disk,
    log,
    file_size,
    no_image,   ///< no file, or no regular file
    bad_image,  ///< empty, damaged, another format or size, or with pixels that are not finite
    interrupted
  } kind = Kind::not_started;
  std::string sentence;  ///< "ran in 1.2 s", or what is wrong, for the author
  double wall_seconds = 0, cpu_seconds = 0;
  std::uint64_t peak_bytes = 0;  ///< of the process with the highest peak
  std::string log_tail;
  std::optional<Image> image;  ///< linear, row 0 on top, without the declared scale
};

/// The command starts in a new folder of links to the read-only built tree; it may add files and replace links.
/// `output_file` receives the bytes of the image. `program` is photonproof, which decodes (submitted_image.h). Throws
/// InputError for failures of the grader itself: names without a value, a params_place that leads outside.
RunOutcome run_submission(const std::filesystem::path& built, const RunRecipe& recipe,
                          const ImageDeclaration& declaration, const std::filesystem::path& output_file,
                          const std::filesystem::path& program, const Handling& handling = {});

}  // namespace photonproof::inline harness_submissions
