// What the fuzzer of assignments checks of one input; also run over the stored corpus by an ordinary test.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline harness_suites {

/// Empty when `bytes` are refused with a proper message or read into something that keeps its promises; else what went
/// wrong.
std::string check_assignment(std::string_view bytes);

}  // namespace photonproof::inline harness_suites
