// Checks one input of the fuzzer of EXR files; an ordinary test also runs it over the stored corpus.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline scenes_images {

/// Empty when `bytes` are refused with a proper message or read into a valid image; else the problem.
std::string check_exr(std::string_view bytes);

}  // namespace photonproof::inline scenes_images
