// Rows and columns that were left out or are off from their neighbours, as tiles do that do not meet.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {

/// At most one finding, of rows and columns together; their pixels become ignored.
std::optional<Finding> find_lines(const Image& submitted, const Image& reference, std::vector<std::uint8_t>& ignored);

}  // namespace photonproof::inline harness_diagnosis
