// What the fuzzer of PNG files checks of one input; also run over the stored corpus by an ordinary test.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline scenes_images {

/// Empty when `bytes` are refused with a proper message or read into something that keeps its promises; else what went
/// wrong.
std::string check_png(std::string_view bytes);

}  // namespace photonproof::inline scenes_images
