// The median of pixels' values, which outliers do not move.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace photonproof::inline harness_pixels {

/// The median; the upper of the two middle values if the number is even, 0 if there is none.
template <class Value>
Value middle_of(std::vector<Value> values) {
  if (values.empty()) return Value{0};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace photonproof::inline harness_pixels
