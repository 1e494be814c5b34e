// Bytes that the page's scripts inflate again.
#pragma once

#include <string>

namespace photonproof::reports::inline reports_view {

/// In zlib's format.
std::string deflated(const std::string& bytes);

}  // namespace photonproof::reports::inline reports_view
