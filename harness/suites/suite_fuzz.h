// Checks of the fuzzer of suites for one input; an ordinary test also runs them over the stored corpus.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline harness_suites {

/// Empty if `bytes` are refused with a proper message, or read into a suite that keeps its promises; else the error.
std::string check_suite(std::string_view bytes);

}  // namespace photonproof::inline harness_suites
