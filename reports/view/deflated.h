// Compresses bytes that the page's scripts inflate.
#pragma once

#include <string>

namespace photonproof::reports::inline reports_view {

/// The bytes in zlib's format.
std::string deflated(const std::string& bytes);

}  // namespace photonproof::reports::inline reports_view
