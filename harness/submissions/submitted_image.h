// Reads a submission's image file as the linear image that the assignment declares.
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
  std::string wrong;           ///< if there is none: a sentence that begins with `shown_name`
};

/// Opens `file` without following a link or waiting for a pipe. Decodes it in a sandboxed process of its own, `program`
/// (photonproof) with its hidden verb. Messages call the file `shown_name`. Throws InputError for failures of the
/// grader itself.
SubmittedImage read_submitted_image(const std::filesystem::path& file, const std::string& shown_name,
                                    const ImageDeclaration& declaration, const std::filesystem::path& program,
                                    const Handling& handling = {});

/// Converts the file's numbers to the image that the declaration describes, in place.
void undo_declaration(Image& image, const ImageDeclaration& declaration);

}  // namespace photonproof::inline harness_submissions
