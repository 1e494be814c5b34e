// A submission's images of one scene: drawn until the verdict is decided, with its pictures and what is wrong with
// them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/grading/grade_runs.h"
#include "harness/grading/scene_judge.h"

namespace photonproof::inline harness_grading {

/// A scene's grade and the images behind it, in the order of their runs.
struct SceneWorkGrade {
  SceneGrade grade;
  std::vector<Image> images;
  /// The second one again, where the first run may have left files, and where its image lies, too. The former is drawn
  /// only where the latter is the first one.
  std::optional<Image> in_used_place, in_littered_place;

  /// There are images of two seeds, and they differ.
  bool seed_shows() const { return images.size() > 1 && images[0].rgb != images[1].rgb; }
};

struct SceneGradingOptions {
  std::size_t least_images = 1;  ///< so many at least: two tell whether the seed is heeded
  bool in_used_place = false;    ///< and whether a run uses what another has left, or any image that lies around
  bool reuse = false;            ///< runs that an interrupted grading left
};

/// Empty when interrupted.
std::optional<SceneWorkGrade> grade_scene(const Assignment& assignment, const PreparedSubmission& submission,
                                          const WorkScene& scene, const SceneReference& reference, GradeRuns& runs,
                                          const SceneGradingOptions& options);

/// The first image and its flip map as PNGs in `place`, relative to `folder`; into grade.pictures.
void store_scene_pictures(const std::filesystem::path& folder, const std::string& place,
                          const SceneReference& reference, SceneWorkGrade& work);

}  // namespace photonproof::inline harness_grading
