// Checks one input of the fuzzer of checkpoints; an ordinary test also runs it over the stored corpus.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline renderer_sensor {

/// Empty when `bytes` are refused with a proper message or read into a valid checkpoint; else the problem.
std::string check_checkpoint(std::string_view bytes);

}  // namespace photonproof::inline renderer_sensor
