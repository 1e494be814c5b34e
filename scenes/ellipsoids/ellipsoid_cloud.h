// Clouds of ellipsoids from PLY files as 3D Gaussian splatting writes them (Kerbl, Kopanas, Leimkuehler and Drettakis
// 2023: "3D Gaussian Splatting for Real-Time Radiance Field Rendering") and Mitsuba reads them. Files are untrusted: a
// cloud takes no more memory than a fixed multiple of its file.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_ellipsoids {

struct Ellipsoid {
  Vec3f center;
  Vec3f scale;                            ///< semi-axes at an extent of 1: a Gaussian's standard deviations; positive
  std::array<float, 4> turn{0, 0, 0, 1};  ///< unit quaternion x y z w, from the ellipsoid's axes to the file's
  friend bool operator==(const Ellipsoid&, const Ellipsoid&) = default;
};

struct EllipsoidCloud {
  std::vector<Ellipsoid> ellipsoids;  ///< At least one. All numbers are finite.
  std::vector<float> opacities;       ///< One for each, from 0 to 1. Empty where the file has none.
  std::vector<Rgb> harmonics;         ///< `coefficients` for each, by ascending degree and order. Empty without any.
  std::size_t coefficients = 0;       ///< 0, or the square of degree + 1.

  /// Whether the ellipsoids have all that a radiance field needs.
  bool is_radiance_field() const { return !opacities.empty() && !harmonics.empty(); }
  friend bool operator==(const EllipsoidCloud&, const EllipsoidCloud&) = default;
};

constexpr std::size_t kMaxCloudBytes = std::size_t{8} << 30;
constexpr std::size_t kMostHarmonicDegree = 8;

/// Reads the first element of the file. Its properties are x y z nx ny nz, then others, then scale_0 to scale_2 and
/// rot_0 to rot_3. Scales are logarithms, and rotations are w x y z of any length but 0. The others are f_dc_0 ...
/// opacity of Gaussian splatting. There the opacity is a logit, and harmonics are channel after channel beyond the
/// first three. Else they are attributes by prefix, of which `opacities` and `sh_coeffs` are read as they are. Throws
/// InputError: with file:line:col for the header and for text, with byte and row for binary values.
EllipsoidCloud parse_ellipsoids(std::string_view bytes, const std::string& file);

}  // namespace photonproof::inline scenes_ellipsoids
