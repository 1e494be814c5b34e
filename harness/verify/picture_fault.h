// Finds a mistake of the whole picture, independent of its content: upside down, channels exchanged, another tone
// curve, moved by a part of a pixel. Each is tried on the right picture and must explain most of the difference. Use a
// picture in which every surface emits (passes.h, "shapes"). There a mirrored texture does not look like a mirrored
// camera.
#pragma once

#include <optional>
#include <string>

#include "harness/verify/engine_picture.h"

namespace photonproof::inline harness_verify {

struct PictureFault {
  std::string pass;      ///< "camera" or "tone"
  std::string sentence;  ///< "the picture is 0.5 px too far left"
  std::string cause;     ///< may be empty
};

std::optional<PictureFault> picture_fault(const EnginePicture& right, const EnginePicture& odd);

}  // namespace photonproof::inline harness_verify
