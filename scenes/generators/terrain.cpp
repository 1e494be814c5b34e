#include "scenes/generators/terrain.h"

#include <algorithm>

#include "scenes/generators/gradient_noise.h"
#include "scenes/meshes/icosphere.h"

namespace photonproof::inline scenes_generators {
namespace {

enum Seed : std::uint32_t { kHills = 11, kRidges = 101, kPlaces = 1001, kStone = 2001 };

/// 0 below `low`, 1 above `high`, smooth between.
double step(double low, double high, double v) {
  const double t = std::clamp((v - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A rock's own random numbers.
double random(std::uint32_t rock, std::uint32_t what) { return unit_hash(rock, what, 0, kPlaces); }

struct Rock {
  Vec3d center;
  Vec3d size;           ///< half axes
  double c = 1, s = 0;  ///< cosine and sine of its turn about y
};

Rock place_rock(std::uint32_t number) {
  const auto within = [&](std::uint32_t what) { return (2 * random(number, what) - 1) * (kTerrainHalfSize - 0.6); };
  const double x = within(0), z = within(1);
  // Few are large: the density falls with the cube of the size.
  const double u = random(number, 2);
  const double radius = 0.07 / std::sqrt(1.0 - 0.96 * u);
  Rock rock;
  rock.size =
      Vec3d{0.8 + 0.5 * random(number, 3), 0.6 + 0.4 * random(number, 4), 0.8 + 0.5 * random(number, 5)} * radius;
  rock.center = {x, ground_height(x, z) + 0.3 * rock.size.y, z};
  // A rational point of the unit circle, for want of a sine with the same bits everywhere.
  const double t = 2 * random(number, 6) - 1;
  rock.c = (1 - t * t) / (1 + t * t);
  rock.s = 2 * t / (1 + t * t);
  return rock;
}

Vec3d surface(const Rock& rock, std::uint32_t number, const Vec3d& direction) {
  const double bumps = 1 + 0.3 * fractal_noise(direction * 1.5, 5, kStone + 16 * number);
  const Vec3d p{direction.x * rock.size.x * bumps, direction.y * rock.size.y * bumps,
                direction.z * rock.size.z * bumps};
  return rock.center + Vec3d{rock.c * p.x + rock.s * p.z, p.y, rock.c * p.z - rock.s * p.x};
}

}  // namespace

double ground_height(double x, double z) {
  const Vec3d p{x, 0.37, z};
  const double far = step(4, -7, z), farther = step(0, -9, z);
  const double hills = 0.55 * fractal_noise(p * 0.33, 9, kHills);
  const double ridges = ridged_noise(p * 0.14, 9, kRidges);
  return hills * (1 + far) + far * (1.5 * ridges - 0.9) + farther * 1.1 * ridges;
}

TriangleMesh make_ground(std::uint32_t columns, std::uint32_t rows) {
  TriangleMesh mesh;
  const std::size_t stride = std::size_t{columns} + 1;
  mesh.resize_positions(stride * (std::size_t{rows} + 1));
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const double x = kTerrainHalfSize * (2.0 * i / columns - 1);
      const double z = kTerrainHalfSize * (2.0 * j / rows - 1);
      mesh.positions[j * stride + i] = Vec3f(Vec3d{x, ground_height(x, z), z});
    }
  mesh.triangles.reserve(std::size_t{2} * columns * rows);
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * stride + i);
      const std::uint32_t b = a + 1, c = a + columns + 1, d = c + 1;  // a b at this z, c d at the next
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  return mesh;
}

TriangleMesh make_rocks(std::uint32_t count, int level) {
  const Icosphere ball = make_icosphere(level);
  TriangleMesh mesh;
  mesh.resize_positions(count * ball.directions.size());
  mesh.triangles.reserve(count * ball.triangles.size());
  for (std::uint32_t n = 0; n < count; ++n) {
    const Rock rock = place_rock(n);
    const auto first = static_cast<std::uint32_t>(n * ball.directions.size());
    for (std::uint32_t i = 0; i < ball.directions.size(); ++i)
      mesh.positions[first + i] = Vec3f(surface(rock, n, ball.directions[i]));
    for (const TriangleMesh::Triangle& t : ball.triangles)
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return mesh;
}

}  // namespace photonproof::inline scenes_generators
