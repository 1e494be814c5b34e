// Groups of submissions with the same images, or with images of the same noise.
#pragma once

#include <string>
#include <vector>

#include "reports/grades/grade_record.h"

namespace photonproof::reports::inline reports_grades {

struct LikenessGroup {
  std::vector<std::string> names;  ///< of submissions, at least two, in the record's order
  std::string why;                 ///< "the same image of scene 1, bit for bit", "the same noise"
};

/// Groups by the checksums of images, one for all scenes that the same submissions share, and by the flags
/// "same-as-other".
std::vector<LikenessGroup> likeness_groups(const Grades& grades);

}  // namespace photonproof::reports::inline reports_grades
