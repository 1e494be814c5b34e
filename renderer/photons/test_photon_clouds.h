// Photons and queries for the tests of the photon structures: shapes that are difficult for grids and trees.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/lanes/test_random.h"
#include "renderer/photons/photons.h"

namespace photonproof::inline renderer_photons {

enum class Cloud { uniform, clumps, power_law, walls, line, one_point };

inline const std::vector<Cloud> all_clouds{Cloud::uniform, Cloud::clumps, Cloud::power_law,
                                           Cloud::walls,   Cloud::line,   Cloud::one_point};

inline std::string name_of(Cloud cloud) {
  switch (cloud) {
    case Cloud::uniform:
      return "uniform";
    case Cloud::clumps:
      return "clumps";
    case Cloud::power_law:
      return "power_law";
    case Cloud::walls:
      return "walls";
    case Cloud::line:
      return "line";
    case Cloud::one_point:
      return "one_point";
  }
  return "";
}

/// A point of the cloud, about the unit cube.
inline Vec3f cloud_point(Cloud cloud, test::Random& s) {
  const auto xy = s.next2();
  const Vec3f u{xy.x, xy.y, s.next()};
  const auto face = static_cast<int>(6 * s.next());
  switch (cloud) {
    case Cloud::uniform:
      return u;
    case Cloud::clumps: {  // Gaussian about one of six centres, by Box and Muller (1958)
      const float around = 2 * std::numbers::pi_v<float>;
      const float radius = 0.02f * std::sqrt(-2 * std::log(1 - u.x));
      const auto centre = static_cast<float>(face);
      const float height = 0.02f * std::sqrt(-2 * std::log(1 - s.next())) * std::cos(around * u.z);
      return {0.15f * centre + radius * std::cos(around * u.y), 0.5f + radius * std::sin(around * u.y), 0.9f + height};
    }
    case Cloud::power_law:
      return u * u * u * u;
    case Cloud::walls: {
      const float wall = face % 2 == 0 ? 0.0f : 1.0f;
      return face < 2 ? Vec3f{wall, u.y, u.z} : face < 4 ? Vec3f{u.x, wall, u.z} : Vec3f{u.x, u.y, wall};
    }
    case Cloud::line:
      return {0.25f, u.y, 0.75f};
    case Cloud::one_point:
      return {0.5f, 0.5f, 0.5f};
  }
  return u;
}

/// Photon i carries i as its surface and i % 16 as its edges; fluxes are small whole numbers, whose sums are exact in
/// any order.
inline Photons make_cloud(Cloud cloud, int count) {
  Photons photons;
  for (int i = 0; i < count; ++i) {
    test::Random s(41, static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(cloud));
    const Vec3f p = cloud_point(cloud, s);
    const auto flux = static_cast<float>(i % 128);
    photons.push_back({p, {flux, flux + 1, 2 * flux}, static_cast<std::uint32_t>(i), i % 16});
  }
  return photons;
}

/// Query q: a point of the cloud, one of the photons, within the photons' bounds or outside them.
inline Vec3f query_point(Cloud cloud, const Photons& photons, std::uint64_t q) {
  test::Random s(42, q);
  const Vec3f near = cloud_point(cloud, s);
  const Vec3f jitter{s.next() - 0.5f, s.next() - 0.5f, s.next() - 0.5f};
  switch (q % 4) {
    case 0:
      return photons[q % photons.size()].p_world;
    case 1:
      return near;
    case 2:
      return near + jitter * 0.02f;
    default:
      return Vec3f(0.5f) + jitter * 1.4f;
  }
}

/// Squared distance as the structures document it.
inline float distance_squared(const Photons& photons, std::size_t i, const Vec3f& p) {
  const float dx = photons.x[i] - p.x, dy = photons.y[i] - p.y, dz = photons.z[i] - p.z;
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace photonproof::inline renderer_photons
