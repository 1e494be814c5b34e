// Pictures of a history: those of a record, and those that two commits show differently.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/history/history_file.h"
#include "reports/history/history_comparison.h"
#include "reports/record/results.h"

namespace photonproof::inline harness_history {

/// Pixels a side that a kept picture has at most.
inline constexpr int largest_kept = 512;

/// The picture of each scene, engine and budget by its first seed, and of each gate. `folder` is the record's. Pictures
/// that are missing or cannot be decoded are left out.
std::vector<HistoryPicture> pictures_of(const Results& results, const std::filesystem::path& folder);

/// Compares pictures of the same cell and seed, and fills in the members about pictures. Of the `most` that differ most
/// it writes 1-old.png, 1-new.png, 1-difference.png ... to `folder`, which is made; FLIP is the difference. Their names
/// begin with the folder's own name. Throws InputError when they cannot be written.
void compare_pictures(const std::vector<HistoryPicture>& base, const std::vector<HistoryPicture>& head,
                      const std::filesystem::path& folder, std::size_t most, reports::HistoryComparison& comparison);

}  // namespace photonproof::inline harness_history
