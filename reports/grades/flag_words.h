// The kinds of a grading's flags in words, and the flags that cost a place in the ranking.
#pragma once

#include <string>

#include "reports/grades/grade_record.h"

namespace photonproof::reports::inline reports_grades {

/// Two to five words for a table: "results kept". A kind without a row: its hyphens become blanks.
std::string flag_name(const std::string& kind);

/// One sentence on what was seen: "An image of an earlier run comes back." A kind without a row: empty.
std::string flag_meaning(const std::string& kind);

}  // namespace photonproof::reports::inline reports_grades
