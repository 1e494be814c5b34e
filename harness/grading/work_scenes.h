// The scenes of an assignment, ready to be rendered by submissions: variants made and their predictions checked, files
// in the course's format written, arguments filled in.
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

struct WorkScene {
  AssignmentScene row;
  std::optional<SceneDescription> description;  ///< of the variant where it is one
  std::optional<Variant> variant;
  int width = 0, height = 0;
  std::string says;                  ///< of a variant
  std::string unused;                ///< why it must not be graded on; empty: it counts
  std::string params, params_place;  ///< the file that the program is given of it: text and place; empty: none
  SceneFolder folder;                ///< for a program that reads our format
  std::optional<Image> given;        ///< what students have of it
};

/// What programs are given of scenes is made in `folder`. Throws InputError for a scene that cannot be made: of this
/// kind, or not in the course's format.
std::vector<WorkScene> make_work_scenes(const Assignment& assignment, const SubmissionRunner& runner,
                                        const OwnEngine& engine, const std::filesystem::path& folder,
                                        const std::function<void(const std::string&)>& progress);

/// What a run on the scene is asked for; {output}, {params} and {scene} are left open.
SubmissionRunRequest request_of(const Assignment& assignment, const WorkScene& scene, std::uint64_t seed, int threads);

}  // namespace photonproof::inline harness_grading
