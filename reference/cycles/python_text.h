// Writes Python numbers, tuples and strings. No text of a scene file can leave a string or a comment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/base/vec.h"
#include "scenes/description/transform.h"

namespace photonproof::inline reference_cycles {

/// "(x, y, z)", each number the shortest text that reads back as the same double.
std::string py_tuple(const Vec3d& v);
/// "(a, b, c)"; of one part "(a,)".
std::string py_tuple(const std::vector<std::string>& parts);
/// The columns x, y, z and place of a matrix, each a tuple.
std::string py_columns(const Transform& t);
/// In double quotes, printable ASCII: other bytes become '?'.
std::string py_string(std::string_view text);

}  // namespace photonproof::inline reference_cycles
