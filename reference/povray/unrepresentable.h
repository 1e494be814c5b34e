// A scene that another engine cannot express. Refusing is an answer: it is never approximated silently.
#pragma once

#include <string>

#include "scenes/text/input_error.h"

namespace photonproof {

/// `summary()` is "file:line:col: error: not representable in POV-Ray: why". An InputError, so that code that knows
/// nothing of engines reports it as bad input; the verbs give it an exit code of its own.
class Unrepresentable : public InputError {
 public:
  Unrepresentable(const std::string& where, const std::string& why)
      : InputError(where, "not representable in POV-Ray: " + why) {}
};

}  // namespace photonproof
