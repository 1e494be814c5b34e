// Phrases of plans.
#pragma once

#include <cstddef>
#include <string>

namespace photonproof::inline renderer_planning {

inline std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

inline std::string depth_words(int max_depth) {
  return max_depth < 0 ? "paths of any length" : "paths of at most " + counted(std::size_t(max_depth), "edge", "edges");
}

}  // namespace photonproof::inline renderer_planning
