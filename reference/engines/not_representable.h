// A scene that another engine cannot express. Such a scene is refused and never approximated silently.
#pragma once

#include <string>

#include "scenes/base/input_error.h"

namespace photonproof::inline reference_engines {

/// `summary()` is "file:line:col: error: not representable in ENGINE: why". It is an InputError, so generic code
/// reports it as bad input; the commands give it its own exit code.
class NotRepresentable : public InputError {
 public:
  NotRepresentable(const std::string& engine, const std::string& where, const std::string& why)
      : InputError(where, "not representable in " + engine + ": " + why) {}
};

}  // namespace photonproof::inline reference_engines
