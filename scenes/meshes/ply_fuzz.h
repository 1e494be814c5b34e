// What the PLY reader's fuzzer checks of one input; also run over the stored corpus by an ordinary test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace photonproof::inline scenes_meshes {

/// Empty when `bytes` are refused with a proper message, or are a mesh that keeps its promises and survives writing and
/// reading; else what went wrong.
std::string check_ply(std::string_view bytes);

}  // namespace photonproof::inline scenes_meshes

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
