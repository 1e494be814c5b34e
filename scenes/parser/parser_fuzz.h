// Checks one input of the parser's fuzzer; an ordinary test also runs it over the stored corpus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace photonproof::inline scenes_parser {

/// Empty when `text` is refused with a proper message, or is a scene that survives writing and reading; else the
/// problem.
std::string check_parser(std::string_view text);

}  // namespace photonproof::inline scenes_parser

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
