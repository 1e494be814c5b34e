// JSON text for files and for printing.
#pragma once

#include <string>

namespace photonproof::inline scenes_base {

/// Indented by two. File names and other programs' output may be any bytes. Bytes that are not UTF-8 become U+FFFD,
/// where the library alone would throw.
template <class Json>
std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace photonproof::inline scenes_base
