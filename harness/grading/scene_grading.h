// A submission's images of one scene: drawn until the verdict is decided, with pictures and findings.
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
  /// The second image again: in a place where the first run may have left files, and in one where its image lies, too.
  /// The former is drawn only where the latter equals the first image.
  std::optional<Image> in_used_place, in_littered_place;

  /// True if there are images of two seeds, and they differ.
  bool seed_shows() const { return images.size() > 1 && images[0].rgb != images[1].rgb; }
};

struct SceneGradingOptions {
  std::size_t least_images = 1;  ///< The least number of images: two show whether the seed is used.
  bool in_used_place = false;    ///< Also tests whether a run uses another run's files or image.
  bool reuse = false;            ///< Uses the runs of an interrupted grading.
};

/// Empty when interrupted.
std::optional<SceneWorkGrade> grade_scene(const Assignment& assignment, const PreparedSubmission& submission,
                                          const WorkScene& scene, const SceneReference& reference, GradeRuns& runs,
                                          const SceneGradingOptions& options);

/// Writes the first image and its flip map as PNGs to `place`, relative to `folder`, and sets grade.pictures.
void store_scene_pictures(const std::filesystem::path& folder, const std::string& place,
                          const SceneReference& reference, SceneWorkGrade& work);

}  // namespace photonproof::inline harness_grading
