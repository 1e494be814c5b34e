// Compares a measured cell with its scene's reference: metrics, and the pictures that reports show.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reports/record/results.h"

namespace photonproof::inline harness_bench {

struct CellComparison {
  std::filesystem::path results_folder;
  std::string cell_folder;            ///< of the cell, relative to results_folder; receives the pictures
  const Result* reference = nullptr;  ///< null while there is none yet; the cell's own result for the reference itself
  double exposure = 0;                ///< stops
  std::optional<ExposureRange> hdr_exposures{};  ///< of hdr_flip, which needs them
};

/// Replaces `result`'s metrics, pictures and the warning that gives the reason why there are none. The reference itself
/// gets its picture and no metrics. A result whose image cannot be read becomes a bad image. Precondition:
/// result.status is ok. Throws InputError when a picture cannot be written.
void compare_cell(const CellComparison& comparison, Result& result);

}  // namespace photonproof::inline harness_bench
