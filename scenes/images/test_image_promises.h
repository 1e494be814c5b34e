// Guarantees of every reader of images, for the fuzzers of all of them.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof::inline scenes_images {

/// Empty when the file is refused with a proper message, or its rows are the same read one at a time, from the end and
/// all at once. Otherwise the problem. For large images only the first and the last rows are read.
std::string problem_with_image(const std::filesystem::path& file);

}  // namespace photonproof::inline scenes_images
