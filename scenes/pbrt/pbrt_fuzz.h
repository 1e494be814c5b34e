// Checks one input of the fuzzer of pbrt scenes; an ordinary test also runs it over the stored corpus.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline scenes_pbrt {

/// Empty when `bytes` are refused with proper messages or read into a scene that can be written; else the problem.
std::string check_pbrt(std::string_view bytes);

}  // namespace photonproof::inline scenes_pbrt
