// Grids of numbers in a box from Mitsuba's volume files (.vol, version 3). Files are untrusted: a grid is never larger
// than its file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_meshes {

struct VolumeGrid {
  int width = 1, height = 1, depth = 1;  ///< cells along x, y and z
  int channels = 1;                      ///< 1 or 3
  Vec3f low{0, 0, 0}, high{1, 1, 1};     ///< the file's box; `high` is above `low` on every axis
  std::vector<float> values;             ///< x fastest, then y, then z, a cell's channels together; finite
  float largest = 0;                     ///< of the values

  friend bool operator==(const VolumeGrid&, const VolumeGrid&) = default;
};

constexpr std::size_t kMaxVolBytes = std::size_t{4} << 30;

enum class VolValues { not_negative, any };

/// Throws InputError about `file`, with the byte where that is known.
VolumeGrid parse_vol(std::string_view bytes, const std::string& file, VolValues allowed = VolValues::not_negative);

}  // namespace photonproof::inline scenes_meshes
