// Clarberg, "Fast equal-area mapping of the (hemi)sphere using SIMD" (2008): the square images of pbrt-v4's infinite
// lights as latitude-longitude images.
#pragma once

#include "scenes/base/vec.h"
#include "scenes/description/transform.h"
#include "scenes/images/image.h"

namespace photonproof::inline scenes_pbrt {

/// The point of the unit square for a direction of unit length. +z is the middle, -z are the corners.
Vec2<double> equal_area_square(const Vec3d& direction);

/// The image of an `envmap` with the identity as its to_world. `to_light` turns the envmap's directions to those of the
/// square image; the mean over the sphere stays, up to the width of a pixel.
Image latitude_longitude(const Image& square, const Transform& to_light);

}  // namespace photonproof::inline scenes_pbrt
