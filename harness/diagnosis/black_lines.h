// Rows and columns that are missing or deviate from their neighbours, as between tiles that do not meet.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {

/// At most one finding for rows and columns together; their pixels become ignored.
std::optional<Finding> find_lines(const Image& submitted, const Image& reference, std::vector<std::uint8_t>& ignored);

}  // namespace photonproof::inline harness_diagnosis
