#include "renderer/irradiance/irradiance_record.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/lanes/warp.h"
#include "renderer/photons/surface_side.h"

namespace photonproof::inline renderer_irradiance {
namespace {

constexpr double pi_of_records = std::numbers::pi;

/// Weights of a grid's cells in the sums. Cell (j, k) has polar angles from asin sqrt(j/M) to asin sqrt((j+1)/M) and
/// azimuths from 2 pi k/N to 2 pi (k+1)/N.
struct CellShape {
  explicit CellShape(const HemisphereGrid& grid) : grid_(grid) {}
  double sine(int j) const { return std::sqrt(static_cast<double>(j) / grid_.polar); }
  double cosine(int j) const { return std::sqrt(1 - static_cast<double>(j) / grid_.polar); }
  /// Integral of sin^2 over the polar angles of stratum j.
  double squared_sine(int j) const {
    const auto integral = [&](int at) { return (std::asin(sine(at)) - sine(at) * cosine(at)) / 2; };
    return integral(j + 1) - integral(j);
  }
  double azimuth_step() const { return 2 * pi_of_records / grid_.azimuthal; }
  Vec3d towards(double azimuth) const { return {std::cos(azimuth), std::sin(azimuth), 0}; }

 private:
  const HemisphereGrid& grid_;
};

struct LocalGradients {
  std::array<Vec3d, 3> turned{}, moved{};
};

Vec3d channels(const Rgb& c) { return {double{c.x}, double{c.y}, double{c.z}}; }

void add_to(std::array<Vec3d, 3>& sums, const Vec3d& along, const Vec3d& amounts) {
  sums[0] += along * amounts.x;
  sums[1] += along * amounts.y;
  sums[2] += along * amounts.z;
}

/// Gradients for L constant in each cell. `turned` is the integral of L (z x w). `moved`: as the point moves towards a
/// border of two cells, the cell behind it opens. The border is as far away as the nearer of the two cells.
LocalGradients gradients(const HemisphereGrid& grid, const HemisphereRays& rays, float least_distance) {
  const CellShape cell(grid);
  const double step = cell.azimuth_step();
  const auto index = [&](int j, int k) { return static_cast<std::size_t>(j * grid.azimuthal + k); };
  const auto nearer = [&](std::size_t a, std::size_t b) {
    return double{std::max(least_distance, std::min(rays.distance[a], rays.distance[b]))};
  };
  LocalGradients sums;
  for (int k = 0; k < grid.azimuthal; ++k) {
    const int before = (k + grid.azimuthal - 1) % grid.azimuthal;
    const Vec3d along = cell.towards((k + 0.5) * step), across = cell.towards((k + 0.5) * step + pi_of_records / 2);
    const Vec3d at_border = cell.towards(k * step + pi_of_records / 2);
    for (int j = 0; j < grid.polar; ++j) {
      const std::size_t here = index(j, k), beside = index(j, before);
      const Vec3d radiance = channels(rays.radiance[here]);
      add_to(sums.turned, across * (2 * std::sin(step / 2) * cell.squared_sine(j)), radiance);
      add_to(sums.moved, at_border * ((cell.sine(j + 1) - cell.sine(j)) / nearer(here, beside)),
             radiance - channels(rays.radiance[beside]));
      if (j == 0) continue;
      const std::size_t above = index(j - 1, k);
      const double opened = step * cell.sine(j) * cell.cosine(j) * cell.cosine(j) / nearer(here, above);
      add_to(sums.moved, along * opened, radiance - channels(rays.radiance[above]));
    }
  }
  return sums;
}

Vec3f to_world_of(const std::array<Vec3f, 2>& axes, const Vec3d& v) {
  return axes[0] * static_cast<float>(v.x) + axes[1] * static_cast<float>(v.y);
}

}  // namespace

Vec3f HemisphereGrid::direction(std::size_t cell, float u, float v) const {
  const auto j = static_cast<float>(cell / static_cast<std::size_t>(azimuthal));
  const auto k = static_cast<float>(cell % static_cast<std::size_t>(azimuthal));
  const float squared_sine = std::min((j + u) / static_cast<float>(polar), 1.0f);
  const float azimuth = 2 * std::numbers::pi_v<float> * (k + v) / static_cast<float>(azimuthal);
  const float sine = std::sqrt(squared_sine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), std::sqrt(1 - squared_sine)};
}

HemisphereGrid hemisphere_grid(std::size_t cells) {
  const double polar = std::max(1.0, std::round(std::sqrt(static_cast<double>(cells) / pi_of_records)));
  return {static_cast<int>(polar), static_cast<int>(std::max(3.0, std::round(static_cast<double>(cells) / polar)))};
}

std::array<Vec3f, 2> record_axes(const Vec3f& n) {
  const Frame<float> frame(n);
  return {frame.s, frame.t};
}

Rgb IrradianceRecord::at(const Vec3f& to, const Vec3f& normal) const {
  const Vec3f turn = cross(n, normal), move = to - p;
  const auto channel = [&](float value, std::size_t c) {
    return std::max(0.0f, value + dot(turn, turned[c]) + dot(move, moved[c]));
  };
  return {channel(irradiance.x, 0), channel(irradiance.y, 1), channel(irradiance.z, 2)};
}

IrradianceRecord make_record(const Vec3f& p, const Vec3f& n, const HemisphereGrid& grid, const HemisphereRays& rays,
                             float least_distance) {
  IrradianceRecord record{p, n};
  RgbD sum(0.0);
  double inverse_distances = 0;
  for (std::size_t i = 0; i < grid.cells(); ++i) {
    sum += RgbD(rays.radiance[i]);
    inverse_distances += 1 / double{std::max(least_distance, rays.distance[i])};
  }
  const double cells = static_cast<double>(grid.cells());
  record.irradiance = Rgb(sum * (pi_of_records / cells));
  record.radius = static_cast<float>(cells / std::max(inverse_distances, 1e-30));
  const std::array<Vec3f, 2> axes = record_axes(n);
  const LocalGradients local = gradients(grid, rays, least_distance);
  for (std::size_t c = 0; c < 3; ++c) {
    record.turned[c] = to_world_of(axes, local.turned[c]);
    record.moved[c] = to_world_of(axes, local.moved[c]);
  }
  return record;
}

}  // namespace photonproof::inline renderer_irradiance
