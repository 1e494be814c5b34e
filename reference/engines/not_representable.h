// A scene that another engine cannot express. Refusing is an answer: it is never approximated silently.
#pragma once

#include <string>

#include "scenes/base/input_error.h"

namespace photonproof::inline reference_engines {

/// `summary()` is "file:line:col: error: not representable in ENGINE: why". An InputError, so that code that knows
/// nothing of engines reports it as bad input; the verbs give it an exit code of its own.
class NotRepresentable : public InputError {
 public:
  NotRepresentable(const std::string& engine, const std::string& where, const std::string& why)
      : InputError(where, "not representable in " + engine + ": " + why) {}
};

}  // namespace photonproof::inline reference_engines
