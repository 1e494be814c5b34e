// A scene that POV-Ray cannot express.
#pragma once

#include <string>

#include "reference/engines/not_representable.h"

namespace photonproof::inline reference_povray {

class Unrepresentable : public NotRepresentable {
 public:
  Unrepresentable(const std::string& where, const std::string& why) : NotRepresentable("POV-Ray", where, why) {}
};

}  // namespace photonproof::inline reference_povray
