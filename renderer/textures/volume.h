// Volumes of the compiled scene: values that vary in space. Meaning as in Mitsuba 3.
#pragma once

#include <array>
#include <memory>

#include "renderer/core/ray.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_textures {

/// The frame of rays: p = world x scale + moved.
struct VolumeFrame {
  Vec3d moved{0, 0, 0};
  double scale = 1;
};

/// A value that varies in space.
class Volume {
 public:
  Volume(const VolumeColour& value, const VolumeFrame& frame);
  Rgb at(const Vec3f& p) const;
  struct Span {
    float begin, end;  ///< none where begin >= end
  };
  /// The part of a ray from 0 to `distance` in the box of the volume, whose sides are along the world's axes.
  Span inside(const Vec3f& origin, const Vec3f& direction, float distance) const;

 private:
  Vec3f local_point(const Vec3f& p) const;
  Rgb cell(const std::array<int, 3>& index) const;
  int wrapped(int i, int cells) const;

  Rgb constant_;
  std::shared_ptr<const VolumeGrid> grid_;  ///< empty where the value is constant
  VolumeFilter filter_ = VolumeFilter::trilinear;
  TextureWrap wrap_ = TextureWrap::clamp;
  std::array<Vec3f, 3> axes_;  ///< the rows of the map to the unit cube
  Vec3f offset_;
  Vec3f low_, high_;  ///< of the box
};

}  // namespace photonproof::inline renderer_textures
