// Checks one input of the IES reader's fuzzer; an ordinary test also runs it over the stored corpus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace photonproof::inline scenes_meshes {

/// Empty when `bytes` are refused with a proper message or read into a valid profile; else the problem.
std::string check_ies(std::string_view bytes);

}  // namespace photonproof::inline scenes_meshes
