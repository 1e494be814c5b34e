// Checks one input of the fuzzer of scenes of several files; an ordinary test also runs it over the stored corpus.
#pragma once

#include <string>
#include <string_view>

namespace photonproof::inline scenes_parser {

/// Empty when `bytes` are refused with a proper message or read into a valid scene; else the problem.
std::string check_include(std::string_view bytes);

}  // namespace photonproof::inline scenes_parser
