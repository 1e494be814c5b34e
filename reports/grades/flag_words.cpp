#include "reports/grades/flag_words.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace photonproof::reports::inline reports_grades {
namespace {

struct FlagRow {
  std::string_view kind, name, meaning;
};

constexpr std::array<FlagRow, 11> rows{{
    {"copy-of-given", "hand-out copied", "The image is one that was handed out."},
    {"copy-of-reference", "reference copied", "The image has the reference’s own noise."},
    {"same-image", "another scene’s image", "A wrong image equals the one of another scene, bit for bit."},
    {"same-as-other", "another team’s noise",
     "Two submissions share their noise, so one of them has the other’s work."},
    {"keeps-results", "results kept", "An image of an earlier run comes back from a file."},
    {"copies-found", "found image copied", "An image that lay in a folder for temporary files comes back."},
    {"seed-ignored", "seed ignored", "Two seeds give the same bits."},
    {"parameters-ignored", "parameters ignored", "Other parameters give the same bits."},
    {"runs-differ", "runs differ", "One seed gives another image every time: the clock or racing threads decide it."},
    {"right-on-public-only", "right on public only", "Every public scene is right, and a hidden one is not."},
    {"fast-on-timed-only", "fast where timed only", "Scenes that are not timed lose half of the speed-up."},
}};

const FlagRow* row_of(const std::string& kind) {
  const auto* const found = std::ranges::find(rows, std::string_view(kind), &FlagRow::kind);
  return found == rows.end() ? nullptr : found;
}

}  // namespace

std::string flag_name(const std::string& kind) {
  if (const FlagRow* row = row_of(kind)) return std::string(row->name);
  std::string words = kind;
  std::ranges::replace(words, '-', ' ');
  return words;
}

std::string flag_meaning(const std::string& kind) {
  const FlagRow* row = row_of(kind);
  return row == nullptr ? std::string() : std::string(row->meaning);
}

}  // namespace photonproof::reports::inline reports_grades
