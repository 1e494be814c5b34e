// Checks one input of the OBJ reader's fuzzer; an ordinary test also runs it over the stored corpus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace photonproof::inline scenes_meshes {

/// Empty when `bytes` are refused with a proper message or read into a valid mesh; else the problem.
std::string check_obj(std::string_view bytes);

}  // namespace photonproof::inline scenes_meshes
