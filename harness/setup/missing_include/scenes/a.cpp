// For the test of std_includes.py: <vector> comes with the header, <algorithm> with nothing of ours.
#include "scenes/a.h"

int find_two(const std::vector<int>& from) {
  // std::sort in a comment needs nothing, "std::count" in a string neither.
  return *std::find(from.begin(), from.end(), 2);
}
