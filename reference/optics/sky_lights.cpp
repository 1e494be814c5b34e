#include "reference/optics/sky_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/optics/point_sets.h"
#include "scenes/sky/clear_sky.h"

namespace photonproof::inline reference_optics {
namespace {

constexpr double sky_pi = std::numbers::pi;

/// An envmap's local direction at `u` of a turn, from -z by way of +x, and `v` of the way from +y to -y.
Vec3d direction_at(double u, double v) {
  const double theta = sky_pi * v, phi = 2 * sky_pi * u;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

/// The radiance of an envmap's image, its first row at the zenith and its last at the nadir, `u` once around.
RgbD radiance_at(const Image& image, double u, double v) {
  const double x = u * image.width - 0.5, y = v * (image.height - 1);
  const double left = std::floor(x), top = std::min(std::floor(y), image.height - 2.0);
  RgbD sum(0.0);
  for (const int j : {0, 1})
    for (const int i : {0, 1}) {
      const int column = ((static_cast<int>(left) + i) % image.width + image.width) % image.width;
      const float* rgb = image.pixel(column, static_cast<int>(top) + j);
      const double weight = (i == 1 ? x - left : 1 - x + left) * (j == 1 ? y - top : 1 - y + top);
      sum += RgbD(double{rgb[0]}, double{rgb[1]}, double{rgb[2]}) * weight;
    }
  return sum;
}

Vec3d turned(const Transform& to_world, const Vec3d& local) { return normalize(to_world.vector(local)); }

/// The place where running sums pass `share` of their last: the cell, and the position in it.
struct Place {
  std::size_t cell;
  double within;
};
Place place_of(const std::vector<double>& sums, double share) {
  const double target = share * sums.back();
  const auto at = std::upper_bound(sums.begin(), sums.end() - 1, target);
  const auto cell = static_cast<std::size_t>(at - sums.begin());
  const double before = cell > 0 ? sums[cell - 1] : 0, mass = sums[cell] - before;
  return {cell, mass > 0 ? (target - before) / mass : 0.5};
}

/// Running sums over a sky's cells, of the mean of their channels times their solid angle.
struct CellSums {
  std::vector<std::vector<double>> in_row;
  std::vector<double> by_row;
  RgbD flux{0.0};
};
CellSums sum_cells(const Image& image) {
  CellSums sums;
  for (int y = 0; y < image.height; ++y) {
    const double solid_angle =
        2 * sky_pi / image.width * (std::cos(sky_pi * y / image.height) - std::cos(sky_pi * (y + 1) / image.height));
    std::vector<double> row;
    for (int x = 0; x < image.width; ++x) {
      const float* p = image.pixel(x, y);
      const RgbD flux = RgbD(double{p[0]}, double{p[1]}, double{p[2]}) * solid_angle;
      sums.flux += flux;
      row.push_back((row.empty() ? 0 : row.back()) + (flux.x + flux.y + flux.z) / 3);
    }
    sums.by_row.push_back((sums.by_row.empty() ? 0 : sums.by_row.back()) + row.back());
    sums.in_row.push_back(std::move(row));
  }
  return sums;
}

}  // namespace

EmitterDescription sky_without_sun(const EmitterDescription& sunsky) {
  const auto& d = std::get<SunSkyDescription>(sunsky.light);
  const ClearSky sky(d.turbidity, d.albedo, normalize(d.sun_direction), d.sky_scale);
  // With an odd number of rows the horizon is one of them.
  auto image = std::make_shared<Image>(512, 513);
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x) {
      const Vec3d up_is_y = direction_at((x + 0.5) / image->width, y / (image->height - 1.0));
      const RgbD rgb = sky.radiance({up_is_y.x, -up_is_y.z, up_is_y.y});
      float* out = image->pixel(x, y);
      out[0] = static_cast<float>(rgb.x);
      out[1] = static_cast<float>(rgb.y);
      out[2] = static_cast<float>(rgb.z);
    }
  Transform up_is_z;  // from an envmap's axes, +y up, to a sunsky's
  up_is_z.m = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
  EnvmapDescription map;
  map.image = std::move(image);
  map.to_world = d.to_world * up_is_z;
  EmitterDescription result = sunsky;
  result.light = std::move(map);
  return result;
}

std::shared_ptr<const Image> sky_image(const EnvmapDescription& map, double gain) {
  const Image& image = *map.image;
  const int fine = std::clamp(1024 / std::max(image.width, 1), 1, 32);
  auto result = std::make_shared<Image>(image.width * fine, std::max(image.height * fine, 2));
  for (int y = 0; y < result->height; ++y)
    for (int x = 0; x < result->width; ++x) {
      const RgbD rgb = radiance_at(image, (x + 0.5) / result->width, (y + 0.5) / result->height) * (map.scale * gain);
      float* out = result->pixel(x, y);
      out[0] = static_cast<float>(rgb.x);
      out[1] = static_cast<float>(rgb.y);
      out[2] = static_cast<float>(rgb.z);
    }
  return result;
}

std::vector<SkyLight> sky_lights(const EnvmapDescription& map, int side, std::uint64_t seed) {
  const std::shared_ptr<const Image> image = sky_image(map, 1);
  const CellSums sums = sum_cells(*image);
  if (!(sums.by_row.back() > 0)) return {};
  std::vector<SkyLight> lights;
  RgbD together(0.0);
  for (const Vec2<double>& s : square_points(side, seed)) {
    const Place row = place_of(sums.by_row, s.y);
    const Place column = place_of(sums.in_row[row.cell], s.x);
    const double u = (static_cast<double>(column.cell) + column.within) / image->width;
    const double v = (static_cast<double>(row.cell) + row.within) / image->height;
    const float* p = image->pixel(static_cast<int>(column.cell), static_cast<int>(row.cell));
    // Its radiance over the density of directions, which is proportional to the mean of the channels.
    const RgbD rgb(double{p[0]}, double{p[1]}, double{p[2]});
    const RgbD irradiance =
        rgb * (sums.by_row.back() / ((rgb.x + rgb.y + rgb.z) / 3) / (static_cast<double>(side) * side));
    together += irradiance;
    lights.push_back({turned(map.to_world, direction_at(u, v)), irradiance});
  }
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 1; };
  const RgbD all{share(sums.flux.x, together.x), share(sums.flux.y, together.y), share(sums.flux.z, together.z)};
  for (SkyLight& light : lights) light.irradiance = light.irradiance * all;
  return lights;
}

std::vector<SkyLight> sun_lights(const SunSkyDescription& sunsky, int side, std::uint64_t seed) {
  const Vec3d sun = normalize(sunsky.sun_direction);
  const double aperture = sunsky.sun_aperture_degrees * sky_pi / 180;
  const RgbD radiance = sun_radiance(sun.z, sunsky.turbidity, aperture) * sunsky.sun_scale;
  if (!(max_component(radiance) > 0)) return {};
  const Vec3d x = normalize(cross(std::abs(sun.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}, sun)), y = cross(sun, x);
  const double least = std::cos(aperture / 2);
  std::vector<SkyLight> lights;
  for (const Vec2<double>& s : square_points(side, seed)) {
    const double z = 1 - s.x * (1 - least), r = std::sqrt(std::max(0.0, 1 - z * z)), phi = 2 * sky_pi * s.y;
    const Vec3d local = sun * z + x * (r * std::cos(phi)) + y * (r * std::sin(phi));
    if (local.z < 0) continue;  // below the horizon nothing shines
    lights.push_back(
        {turned(sunsky.to_world, local), radiance * (cone_solid_angle(aperture) / (static_cast<double>(side) * side))});
  }
  return lights;
}

}  // namespace photonproof::inline reference_optics
