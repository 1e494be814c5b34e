// Dates of commits, as Git and records write them.
#pragma once

#include <cstdint>
#include <string>

namespace photonproof::inline harness_history {

/// Seconds since 1970 (UTC) of "2026-11-29T12:33:53Z", "2026-11-29T13:33:53+01:00" or "2026-11-29", from the year 1970
/// to 9999. Throws InputError at `where` on any other text.
std::int64_t parse_date(const std::string& where, const std::string& text);

}  // namespace photonproof::inline harness_history
