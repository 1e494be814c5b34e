// Checks of the fuzzer of results.json and cell.json for one input; an ordinary test also runs them over the stored
// corpus.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline reports_record {

/// Empty if `bytes` are refused with a proper message, or read into a record that keeps its promises; else the error.
std::string check_results(std::string_view bytes);

}  // namespace photonproof::inline reports_record
