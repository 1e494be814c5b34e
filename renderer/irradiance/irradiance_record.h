// Irradiance around a point: its value and its change as the surface turns and moves (Ward and Heckbert 1992). Rays
// that stratify the hemisphere by cosine measure both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_irradiance {

/// M x N cells of equal projected solid angle: polar strata outside, azimuthal ones inside.
struct HemisphereGrid {
  int polar = 1, azimuthal = 1;
  std::size_t cells() const { return static_cast<std::size_t>(polar) * static_cast<std::size_t>(azimuthal); }
  /// Unit direction, z up, through the point (u, v) in [0,1)^2 of the cell.
  Vec3f direction(std::size_t cell, float u, float v) const;
};

/// About so many cells. There are pi times as many azimuthal as polar strata, so that cells are about as wide as high.
HemisphereGrid hemisphere_grid(std::size_t cells);

/// A ray of each cell: its radiance and the distance of its hit, infinite without a hit.
struct HemisphereRays {
  std::vector<Rgb> radiance;
  std::vector<float> distance;
};

struct IrradianceRecord {
  Vec3f p, n;
  Rgb irradiance{0.0f};
  float radius = 0;               ///< harmonic mean of the distances, bounded
  std::array<Vec3f, 3> turned{};  ///< per channel: (n x n') . turned is the change from n to n'
  std::array<Vec3f, 3> moved{};   ///< per channel: (p' - p) . moved

  /// Extrapolated irradiance at a point near the record.
  Rgb at(const Vec3f& to, const Vec3f& normal) const;
};

/// Makes a record; `least_distance` bounds how steeply irradiance can change.
IrradianceRecord make_record(const Vec3f& p, const Vec3f& n, const HemisphereGrid& grid, const HemisphereRays& rays,
                             float least_distance);

/// The x and y axes of the frame that the grid's directions are in, for records of this normal.
std::array<Vec3f, 2> record_axes(const Vec3f& n);

}  // namespace photonproof::inline renderer_irradiance
