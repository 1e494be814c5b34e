#include "scenes/xml/obstacles.h"

#include <algorithm>
#include <tuple>

namespace photonproof::scene_xml {

void Obstacles::raise() const {
  if (none()) return;
  std::vector<InputError> sorted = errors_;
  std::ranges::stable_sort(sorted, {}, [](const InputError& e) { return std::tuple(e.line(), e.column()); });
  throw InputError(sorted, std::to_string(errors_.size()) + " obstacles; --lenient renders the scene without them");
}

}  // namespace photonproof::scene_xml
