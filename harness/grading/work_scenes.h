// The scenes of an assignment, ready for submissions: variants made and their predictions checked, files in the
// course's format written, arguments filled in.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/grading/assignment.h"
#include "harness/grading/submission_runner.h"
#include "harness/variants/variant.h"
#include "scenes/description/description.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_grading {

/// WorkScene::unused of a scene that this run leaves out.
inline constexpr const char* left_out_by_choice = "--scene leaves it out";

struct WorkScene {
  AssignmentScene row;
  std::optional<SceneDescription> description;  ///< The variant's, where it is one.
  std::optional<Variant> variant;
  int width = 0, height = 0;
  std::string says;                  ///< The variant's prediction.
  std::string unused;                ///< Why it must not be graded; empty: it counts.
  std::string params, params_place;  ///< Text and place of the file that the program gets; empty: none.
  SceneFolder folder;                ///< For a program that reads our format.
  std::optional<Image> given;        ///< The image that students have of it.
};

/// Makes the programs' scene files in `folder`. Throws InputError for a scene that cannot be made: this kind of
/// variant, or the course's format, does not allow it.
std::vector<WorkScene> make_work_scenes(const Assignment& assignment, const SubmissionRunner& runner,
                                        const OwnEngine& engine, const std::filesystem::path& folder,
                                        const std::function<void(const std::string&)>& progress);

/// The request for a run on the scene; {output}, {params} and {scene} are left open.
SubmissionRunRequest request_of(const Assignment& assignment, const WorkScene& scene, std::uint64_t seed, int threads);

}  // namespace photonproof::inline harness_grading
