// A record of many scenes at one look: a row a scene, a column an engine.
#pragma once

#include <string>
#include <vector>

#include "reports/verify/verify_record.h"

namespace photonproof::inline reports_verify {

/// One engine's mean relative to the base's, of the channel that is off most, and its ssim: "-0.12 % 0.998 ✗".
struct OverviewCell {
  std::string words;
  std::string state;  ///< "good", "bad", "open"; empty where there is nothing
};

struct OverviewRow {
  const VerifyScene* scene = nullptr;
  std::vector<OverviewCell> cells;  ///< as the columns; the base's says so
  std::string seen;                 ///< the least error that every pair of those who agree would have shown
};

struct VerifyOverview {
  std::vector<std::string> columns;  ///< engines, the closed form, the stored reference
  std::vector<OverviewRow> rows;     ///< as the record's scenes
  std::string totals;                ///< sentences
};

/// `record` must outlive it.
VerifyOverview verify_overview(const VerifyRecord& record);

inline constexpr const char* verify_overview_words =
    "Each the mean of the image relative to the base's, of the channel that is off most, and ssim. ✗ differs by more "
    "than noise and what is declared explain, ? is not known, – is not rendered.";

}  // namespace photonproof::inline reports_verify
