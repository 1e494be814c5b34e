// The check of the fuzzer of curve files.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline scenes_curves {

/// Empty when the bytes give curves that keep the promises of curve_set.h, or one good error.
std::string check_curves(std::string_view bytes);

}  // namespace photonproof::inline scenes_curves
