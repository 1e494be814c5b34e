// JSON as it is written and printed.
#pragma once

#include <string>

namespace photonproof::inline scenes_base {

/// Indented by two. File names and what other programs say may be any bytes: those that are not UTF-8 become U+FFFD,
/// where the library alone would throw.
template <class Json>
std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace photonproof::inline scenes_base
