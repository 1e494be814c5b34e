// A record of many scenes as a table: one row per scene, one column per engine.
#pragma once

#include <string>
#include <vector>

#include "reports/verify/verify_record.h"

namespace photonproof::inline reports_verify {

/// One engine's mean relative to the base's, in the channel with the largest shift, and its ssim: "-0.12 % 0.998 ✗".
struct OverviewCell {
  std::string words;
  std::string state;  ///< "good", "bad", "open"; empty where there is nothing
};

struct OverviewColumn {
  std::string name, title;  ///< no title: the name says it
};

struct OverviewRow {
  const VerifyScene* scene = nullptr;
  std::vector<OverviewCell> cells;  ///< in the order of the columns; the base's is marked
  std::string seen;                 ///< minimum detectable error of every pair that agrees
};

struct VerifyOverview {
  std::vector<OverviewColumn> columns;  ///< engines that can be used, the closed form, the stored reference
  std::vector<OverviewRow> rows;        ///< in the order of the record's scenes
  std::string totals;                   ///< sentences
};

/// `record` must outlive it.
VerifyOverview verify_overview(const VerifyRecord& record);

inline constexpr const char* verify_overview_words =
    "A cell has the image's mean relative to the base's, in the channel that is off most, and ssim. The signs: ✗ is a "
    "difference beyond noise and the declared error, ? is not known, – is not rendered.";

}  // namespace photonproof::inline reports_verify
