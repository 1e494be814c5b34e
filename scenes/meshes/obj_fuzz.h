// What the OBJ reader's fuzzer checks of one input; also run over the stored corpus by an ordinary test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace photonproof::inline scenes_meshes {

/// Empty when `bytes` are refused with a proper message or read into something that keeps its promises; else what went
/// wrong.
std::string check_obj(std::string_view bytes);

}  // namespace photonproof::inline scenes_meshes
