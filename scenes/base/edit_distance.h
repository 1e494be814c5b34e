// Nearest-name suggestions for messages about unknown names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace photonproof::inline scenes_base {

/// Optimal string alignment distance in bytes: insertions, deletions, replacements and swaps of neighbours, 1 each.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// " (did you mean 'x'?)" for the candidate nearest to `name`; else the empty string. The candidate must be near enough
/// to be a typing error: at most a third of the letters, at least one, differ. Ties go to the first candidate.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// "a, b or c"; "nothing" for an empty list.
std::string join_or(const std::vector<std::string>& names);

}  // namespace photonproof::inline scenes_base
