// A remark on a scene for its user.
#pragma once

#include <string>

namespace photonproof::inline scenes_description {

struct SceneNote {
  std::string where;  ///< file:line:col
  std::string text;   ///< a sentence without its full stop
};

}  // namespace photonproof::inline scenes_description
