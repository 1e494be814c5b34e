// Converts a byte offset in a text to the line and column that messages name.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace photonproof::inline scenes_base {

/// Throws InputError at byte `offset` of the text of `file`, with its line as an excerpt.
[[noreturn]] void fail_at_offset(const std::string& file, std::string_view text, std::size_t offset,
                                 const std::string& message);

}  // namespace photonproof::inline scenes_base
