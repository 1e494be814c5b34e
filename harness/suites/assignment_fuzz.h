// Checks of the fuzzer of assignments for one input; an ordinary test also runs them over the stored corpus.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline harness_suites {

/// Empty if `bytes` are refused with a proper message, or read into an assignment that keeps its promises; else the
/// error.
std::string check_assignment(std::string_view bytes);

}  // namespace photonproof::inline harness_suites
