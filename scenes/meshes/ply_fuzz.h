// Checks one input of the PLY reader's fuzzer; an ordinary test also runs it over the stored corpus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace photonproof::inline scenes_meshes {

/// Empty when `bytes` are refused with a proper message, or are a valid mesh that survives writing and reading; else
/// the problem.
std::string check_ply(std::string_view bytes);

}  // namespace photonproof::inline scenes_meshes

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
