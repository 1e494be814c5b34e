// A file that a submission wrote, as the linear image that the assignment says it means.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "harness/submissions/image_declaration.h"
#include "harness/submissions/submission.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_submissions {

struct SubmittedImage {
  std::optional<Image> image;  ///< linear, row 0 on top, without the declared scale
  std::string wrong;           ///< where there is none: a sentence that begins with `shown_name`
};

/// `file` is opened without following a link or waiting for a pipe, and decoded in a sandboxed process of its own,
/// which is `program` (photonproof) with its hidden verb. `shown_name` is what its author calls it. Throws InputError
/// for the grader's own troubles.
SubmittedImage read_submitted_image(const std::filesystem::path& file, const std::string& shown_name,
                                    const ImageDeclaration& declaration, const std::filesystem::path& program,
                                    const Handling& handling = {});

/// From numbers as in the file to the image that is meant, in place.
void undo_declaration(Image& image, const ImageDeclaration& declaration);

}  // namespace photonproof::inline harness_submissions
