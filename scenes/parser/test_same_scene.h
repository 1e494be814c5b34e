// Whether two descriptions are the same, for the tests of the writer and of the parser. Source positions and file names
// are not part of a scene's content.
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_parser {

/// Empty when the scenes are the same, else the first thing that differs ("shapes[2].to_world").
std::string first_difference(const SceneDescription& a, const SceneDescription& b);

}  // namespace photonproof::inline scenes_parser
