// Surface lights of every kind, sampled from a point and as photons, over random and extreme parameters. Samples are
// compared with the density that scene_lights.h states. They are binned in the surface's own coordinates
// (test_light_patches.h). There the density of directions, converted by cos / distance^2, is smooth.

#include <gtest/gtest.h>

#include <numbers>

#include "renderer/lanes/test_chi_square.h"
#include "renderer/light_sampling/test_lights.h"
#include "renderer/light_sampling/test_surface_lights.h"

namespace photonproof::inline renderer_light_sampling {
namespace {

using test::Lights;
using test::Patch;
using test::PatchPoint;
using test::Random;

constexpr double samples = 1e6;  ///< of photons
/// Number of visible points, in 64 cells. An error of 2 % adds 180 to their chi-square, which is refused from 90 above
/// its mean on.
constexpr double views = 4.5e5;
/// Gauss's two points, exact for polynomials of the third degree.
constexpr std::array<double, 2> nodes{0.5 - 0.5 * std::numbers::inv_sqrt3, 0.5 + 0.5 * std::numbers::inv_sqrt3};

/// Cells of equal sides in the coordinates of some patches.
class Cells {
 public:
  Cells(const std::vector<Patch>& patches, int whole, int of_many)
      : patches_(patches), side_(patches.size() == 1 ? whole : of_many) {}
  int side() const { return side_; }
  std::size_t count() const { return patches_.size() * static_cast<std::size_t>(side_ * side_); }
  /// Cell of a point on the surface; its normal identifies the patch.
  std::size_t of(const Vec3d& p, const Vec3d& n) const {
    std::size_t patch = 0;
    for (std::size_t i = 1; i < patches_.size(); ++i)
      if (dot(patches_[i].facing, n) > dot(patches_[patch].facing, n)) patch = i;
    const Vec2<double> uv = patches_[patch].uv(p);
    const auto step = [&](double x) { return static_cast<int>(std::clamp(std::floor(x * side_), 0.0, side_ - 1.0)); };
    return patch * static_cast<std::size_t>(side_ * side_) + static_cast<std::size_t>(step(uv.y) * side_ + step(uv.x));
  }
  /// Calls value(point, column) at the nodes of a cell and returns its integral over the cell, per du dv.
  template <class Value>
  double integral(std::size_t cell, const Value& value, int finer = 1) const {
    const auto in_patch = static_cast<int>(cell % static_cast<std::size_t>(side_ * side_));
    const Patch& patch = patches_[cell / static_cast<std::size_t>(side_ * side_)];
    double sum = 0;
    for (int part = 0; part < finer * finer; ++part)
      for (const double a : nodes)
        for (const double b : nodes)
          sum += value(patch.at((in_patch % side_ + (part % finer + a) / finer) / side_,
                                (in_patch / side_ + (part / finer + b) / finer) / side_));
    return sum / (4.0 * finer * finer * side_ * side_);
  }
  bool in_first_half(std::size_t cell) const { return 2 * (static_cast<int>(cell) % side_) < side_; }

 private:
  const std::vector<Patch>& patches_;
  int side_;
};

/// Whether two floats differ by more than rounding, if each is within a few 2^-24 of the same quotient by a cosine.
/// `blur` is the relative error of the distance from the rounding of the light's point.
bool differ(float a, float b, double cosine, double blur = 0, double slant = 1) {
  const double rounding = (0x1p-19 + 4 * blur) * (1 + 1 / std::max(cosine * slant, 1e-30));
  return rounding < 0.5 && std::abs(double{a} - double{b}) > rounding * double{std::max(a, b)};
}

/// Expected counts with a density that is 2 % more in the first half of the cells, 2 % less in the other.
template <class InFirstHalf>
std::vector<double> tilted(std::vector<double> expected, const InFirstHalf& in_first_half) {
  for (std::size_t i = 0; i + 1 < expected.size(); ++i) expected[i] *= in_first_half(i) ? 1.02 : 0.98;
  return expected;
}

// --- seen from a point -----------------------------------------------------------------------------------------------

void expect_density_of_view(const test::SurfaceLight& light, const Vec3f& p, double level, std::uint64_t seed) {
  const Lights lights({light.light});
  const test::Seen seen = light.seen(Vec3d(p));
  const Cells cells(seen.patches, 8, 4);
  // Enough samples that `views` of them lie on the side that shines on p. Where nothing shines, every sample must have
  // density 0.
  const auto draws = static_cast<std::uint64_t>(seen.patches.empty() ? views / 10 : views / std::max(seen.share, 0.05));
  std::vector<double> observed(cells.count() + 1), expected(cells.count() + 1);  // last bin: no light
  int wrong = 0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const LightSeen c = lights.scene.sample(p, 0.5f, Random(seed, i).next2());
    if (!(c.pdf > 0) || seen.patches.empty()) {
      observed.back() += 1;
      wrong += c.pdf > 0;
      continue;
    }
    const Vec3d q(c.at.p), n(c.at.normal), d = q - Vec3d(p);
    // Bins use the direction: the point's own rounding would matter where it is close.
    observed[cells.of(Vec3d(p) + Vec3d(c.wi) * length(d), n)] += 1;
    wrong += differ(c.pdf, lights.scene.pdf(c.light, p, c.at), -dot(n, d) / length(d),
                    0x1p-24 * length(q) / std::min(length(d), light.width), light.slant(q, n));
  }
  EXPECT_EQ(wrong, 0) << "samples whose density is not that of the point they found, or from where nothing shines";
  double total = 0;
  for (std::size_t i = 0; i < cells.count(); ++i) {
    const double mass = cells.integral(
        i,
        [&](const PatchPoint& at) {
          const Vec3f q(at.p), n(at.n);
          const double density = lights.scene.pdf(0, p, {q, n, {}, at.triangle});
          if (at.solid_angle > 0) return density * at.solid_angle;
          const Vec3d d = Vec3d(p) - Vec3d(q);  // as rounded as the light's
          return density * at.area * dot(Vec3d(n), d) / (length(d) * dot(d, d));
        },
        3 * seen.finer);
    expected[i] = mass * static_cast<double>(draws);
    total += mass;
  }
  if (seen.share_known) {
    EXPECT_NEAR(total, seen.share, 1e-4 * seen.share) << "the integral of the density over solid angle";
  } else {
    EXPECT_LT(total, 1 + 1e-4);
  }
  if (seen.share < 1 || !seen.share_known) {
    expected.back() = std::max(1 - total, 0.0) * static_cast<double>(draws);
  } else {
    // At a cylinder's silhouette the cosine of a few samples rounds to 0.
    const bool round = light.name.find("cylinder") != std::string::npos;
    EXPECT_LE(observed.back(), round ? 1e-4 * static_cast<double>(draws) : 0) << "samples lost";
    observed.back() = 0;
  }
  EXPECT_GT(test::chi_square_p_value(observed, expected), level);
  if (seen.patches.empty()) return;
  const auto first = [&](std::size_t i) { return cells.in_first_half(i); };
  EXPECT_LT(test::chi_square_p_value(observed, tilted(expected, first)), level) << "an error of 2 % is not noticed";
}

class LightSurfaces : public testing::TestWithParam<test::Setting> {};

TEST_P(LightSurfaces, seen_from_a_point_match_their_density) {
  const std::vector<test::SurfaceLight> lights = test::surface_lights(GetParam());
  int all = 0;
  for (const test::Setting& setting : test::settings)
    for (const test::SurfaceLight& light : test::surface_lights(setting)) all += static_cast<int>(light.places.size());
  std::uint64_t seed = 1000 * GetParam().seed;
  for (const test::SurfaceLight& light : lights)
    for (std::size_t place = 0; place < light.places.size(); ++place) {
      SCOPED_TRACE(light.name + ", place " + std::to_string(place));
      expect_density_of_view(light, light.places[place], test::sidak_level(all), ++seed);
    }
}

// --- photons ---------------------------------------------------------------------------------------------------------

/// A photon's direction in equal steps of sin^2 and of the azimuth from the tangent: equal shares of a cosine lobe.
struct DirectionCell {
  static constexpr int rings = 4, sectors = 4, count = rings * sectors;
  static std::size_t of(const Vec3d& d, const PatchPoint& from) {
    const double x = dot(d, from.along), y = dot(d, cross(from.n, from.along));
    const int ring = std::min(static_cast<int>((x * x + y * y) * rings), rings - 1);
    return static_cast<std::size_t>(ring * sectors +
                                    std::min(static_cast<int>(test::turn(y, x) * sectors), sectors - 1));
  }
  /// The integral over a cell of value(direction) per solid angle, which is d(sin^2) d(phi) / (2 cos).
  template <class Value>
  static double integral(std::size_t cell, const PatchPoint& from, const Value& value) {
    const int ring = static_cast<int>(cell) / sectors, sector = static_cast<int>(cell) % sectors;
    double sum = 0;
    for (const double a : nodes)
      for (const double b : nodes) {
        const double sin2 = (ring + a) / rings, phi = 2 * std::numbers::pi * (sector + b) / sectors;
        const double cosine = std::sqrt(1 - sin2);
        const Vec3d across = from.along * std::cos(phi) + cross(from.n, from.along) * std::sin(phi);
        sum += value(from.n * cosine + across * std::sqrt(sin2)) / (2 * cosine);
      }
    return sum / 4 * 2 * std::numbers::pi / count;
  }
};

void expect_density_of_photons(const test::SurfaceLight& light, double level, std::uint64_t seed) {
  const Lights lights({light.light});
  const Cells cells(light.whole, 8, 3);
  constexpr auto directions = static_cast<std::size_t>(DirectionCell::count);
  std::vector<double> observed(cells.count() * directions + 1), expected(observed.size());  // the last stays empty
  int wrong = 0;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(samples); ++i) {
    Random r(seed, i);
    const Vec2<float> u_position = r.next2();
    const LightStart e = lights.scene.emit(0, u_position, r.next2());
    const Vec3d p(e.at.p), n(e.at.normal), d(e.direction);
    const std::size_t cell = cells.of(p, n);
    const std::size_t patch = cell / static_cast<std::size_t>(cells.side() * cells.side());
    const Vec2<double> uv = light.whole[patch].uv(p);
    PatchPoint from = light.whole[patch].at(std::clamp(uv.x, 0.0, 1.0), uv.y);
    observed[cell * directions + DirectionCell::of(d, from)] += 1;
    const double cosine = dot(n, d);
    const EmissionPdfs<float> pdfs = lights.scene.emit_pdfs(0, e.at, e.direction);
    const float radiance = lights.scene.radiance(0, e.at, e.direction).x;
    const float flux = radiance * static_cast<float>(cosine) / (e.pdfs.first * e.pdfs.second);
    wrong += differ(e.pdfs.first, pdfs.first, 1) || differ(e.pdfs.second, pdfs.second, cosine) ||
             differ(e.flux.x, flux, cosine);
  }
  EXPECT_EQ(wrong, 0) << "photons whose densities or flux are not those of where and whither they start";
  double total = 0;
  for (std::size_t i = 0; i < cells.count(); ++i)
    for (std::size_t k = 0; k < directions; ++k) {
      const double mass = cells.integral(i, [&](const PatchPoint& at) {
        return at.area * DirectionCell::integral(k, at, [&](const Vec3d& d) {
                 const EmissionPdfs<float> pdfs =
                     lights.scene.emit_pdfs(0, {Vec3f(at.p), Vec3f(at.n), {}, at.triangle}, Vec3f(d));
                 return double{pdfs.first} * double{pdfs.second};
               });
      });
      expected[i * directions + k] = mass * samples;
      total += mass;
    }
  EXPECT_NEAR(total, 1, 1e-4) << "the integral of the density over positions and directions";
  EXPECT_GT(test::chi_square_p_value(observed, expected), level);
  const auto near_normal = [&](std::size_t i) { return 2 * static_cast<int>(i % directions) < DirectionCell::count; };
  const auto first = [&](std::size_t i) { return cells.in_first_half(i / directions); };
  EXPECT_LT(test::chi_square_p_value(observed, tilted(expected, near_normal)), level) << "2 % of directions";
  EXPECT_LT(test::chi_square_p_value(observed, tilted(expected, first)), level) << "2 % of positions";
}

TEST_P(LightSurfaces, photons_start_and_leave_by_their_density) {
  const std::vector<test::SurfaceLight> lights = test::surface_lights(GetParam());
  const auto all = static_cast<int>(lights.size() * test::settings.size());
  std::uint64_t seed = 1000 * GetParam().seed + 500;
  for (const test::SurfaceLight& light : lights) {
    SCOPED_TRACE(light.name);
    expect_density_of_photons(light, test::sidak_level(all), ++seed);
  }
}

INSTANTIATE_TEST_SUITE_P(of, LightSurfaces, testing::ValuesIn(test::settings),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace photonproof::inline renderer_light_sampling
