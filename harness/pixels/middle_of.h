// The value in the middle of what pixels have, which outliers do not move.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace photonproof::inline harness_pixels {

/// The median, of an even number the upper one in the middle; 0 of none.
template <class Value>
Value middle_of(std::vector<Value> values) {
  if (values.empty()) return Value{0};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace photonproof::inline harness_pixels
