// UTF-8 checks for untrusted text that ends up in messages and JSON.
#pragma once

#include <string_view>

namespace photonproof {

/// The offset of the first byte that is not part of a well-formed UTF-8 sequence (Unicode 15, table 3-7), or npos.
std::size_t find_invalid_utf8(std::string_view text);

}  // namespace photonproof
