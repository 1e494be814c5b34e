// The surface side that a photon stores, and the photons that a gather counts by it.

#include "renderer/photons/surface_side.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "renderer/kernels/isa.h"
#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/photons/photon_gather.h"
#include "renderer/photons/photon_map.h"

namespace photonproof::inline renderer_photons {
namespace {

constexpr double radian = 180 / 3.14159265358979;

Vec3f direction(std::uint64_t i) {
  test::Random s(51, i);
  return square_to_sphere(s.next2());
}
double angle(const Vec3f& a, const Vec3f& b) {
  return radian * std::acos(std::clamp(dot(normalize(Vec3d(a)), normalize(Vec3d(b))), -1.0, 1.0));
}

TEST(photon_sheet, keeps_normals_to_a_quarter_of_a_degree_and_those_along_axes_exactly) {
  // Rounding moves a point of the octahedron by (1/2, 1/2, -1)/511 at most, 0.0024, which a face's middle, 1/sqrt 3
  // from the centre, shows as 0.0042 = 0.238 degrees.
  double worst = 0;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    const Vec3f n = direction(i);
    worst = std::max(worst, angle(n, unit_side_normal(side_word<float>(n, n))));
  }
  EXPECT_LT(worst, 0.24);
  EXPECT_GT(worst, 0.2);  // of 1e5 normals: if it were exact, something else were stored
  for (const Vec3f& axis : {Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}})
    for (const Vec3f& n : {axis, -axis}) EXPECT_EQ(unit_side_normal(side_word<float>(n, n)), n);
}

TEST(photon_sheet, tells_the_sides_apart_whatever_the_shading_normal) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3f n = direction(i), leaning = normalize(n + direction(i + 5000) * 0.9f);
    const std::uint32_t front = side_word<float>(n, leaning), back = side_word<float>(n, -leaning);
    EXPECT_EQ(back, front + SurfaceSide::from_behind);
    EXPECT_LT(angle(unit_side_normal(back), n), 0.24);
  }
}

TEST(photon_sheet, shares_its_word_with_the_paths_edges) {
  Photons photons;
  for (const std::int32_t edges : {0, 1, 17, 1022, 1023, 5000})
    photons.push_back({{1, 2, 3}, Rgb(1), 4, edges, side_word<float>({0, 0, -1}, {0, 0, 1})});
  const std::int32_t kept[] = {0, 1, 17, 1022, 1023, 1023};
  for (std::size_t i = 0; i < photons.size(); ++i) {
    EXPECT_EQ(photons[i].edges, kept[i]);
    EXPECT_EQ(unit_side_normal(photons[i].surface_side), Vec3f(0, 0, -1));
    EXPECT_EQ(photons[i].surface_side & SurfaceSide::from_behind, SurfaceSide::from_behind);
  }
}

/// Photons about the unit square z = 0, up to 0.1 off it, with normals of every direction, on both sides.
Photons untidy_photons(int count) {
  Photons photons;
  for (int i = 0; i < count; ++i) {
    test::Random s(52, static_cast<std::uint64_t>(i));
    const auto xy = s.next2();
    const Vec3f n = square_to_sphere(s.next2());
    const auto flux = static_cast<float>(i % 128);
    photons.push_back({{xy.x, xy.y, 0.2f * s.next() - 0.1f},
                       {flux, flux + 1, 2 * flux},
                       static_cast<std::uint32_t>(i % 2),
                       i % 16,
                       side_word<float>(n, s.next() < 0.5f ? n : -n)});
  }
  return photons;
}

struct Gathers {
  GatherQueue points;
  std::vector<std::uint32_t> order;
  explicit Gathers(std::uint32_t count) : points(count) {
    for (std::uint32_t q = 0; q < count; ++q) {
      test::Random s(53, q);
      const auto xy = s.next2();
      const Vec3f n = square_to_sphere(s.next2());
      points.push_back({{xy.x, xy.y, 0}, Rgb(1), q, q % 2, q % 3, side_word<float>(n, s.next() < 0.5f ? n : -n)});
      order.push_back(q);
    }
  }
  std::vector<GatheredFlux> gather(const Kernels& kernels, const PhotonMap& map, float radius,
                                   const std::vector<SheetTest>& tests) {
    const GatherPoints view = points.view();
    std::fill_n(view.radius, view.count, radius);
    kernels.gather.gather({map.view(), 12, view, order.data(), tests.data()});
    std::vector<GatheredFlux> flux;
    for (std::size_t q = 0; q < view.count; ++q)
      flux.push_back(
          {{view.flux_red[q], view.flux_green[q], view.flux_blue[q]}, static_cast<std::int32_t>(view.found[q])});
    return flux;
  }
};

TEST(photon_sheet, a_gather_counts_the_same_side_near_the_tangent_plane_with_a_normal_alike) {
  const Photons photons = untidy_photons(20'000);
  const PhotonMap map(photons, 0.1f, Threads(1));
  Gathers gathers(400);
  constexpr float radius = 0.12f;
  for (const SheetTest test : {SheetTest::none, SheetTest::side, SheetTest::side_and_normal}) {
    const auto found = gathers.gather(kernels_for(""), map, radius, {test, test});
    std::int64_t all = 0;
    for (std::size_t q = 0; q < gathers.points.size(); ++q) {
      const GatherPoint point = gathers.points[q];
      const Vec3d normal(unit_side_normal(point.surface_side));
      int count = 0, unsure = 0;
      for (std::size_t i = 0; i < photons.size(); ++i) {
        const Photon photon = photons[i];
        const Vec3d off = Vec3d(photon.p_world) - Vec3d(point.p);
        if (photon.surface != point.surface || photon.edges > 12 - static_cast<int>(point.edges)) continue;
        bool counts = length(off) <= radius;
        bool close = std::abs(length(off) - radius) < 1e-6;
        if (test != SheetTest::none)
          counts = counts && ((photon.surface_side ^ point.surface_side) & SurfaceSide::from_behind) == 0;
        if (test == SheetTest::side_and_normal) {
          const double cosine = dot(normal, Vec3d(unit_side_normal(photon.surface_side)));
          const double height = std::abs(dot(normal, off));
          counts = counts && cosine >= 0.75 && height <= 0.25 * radius;
          close = close || std::abs(cosine - 0.75) < 1e-6 || std::abs(height - 0.25 * radius) < 1e-6;
        }
        count += counts ? 1 : 0;
        unsure += close ? 1 : 0;
      }
      EXPECT_NEAR(found[q].count, count, unsure) << q;
      all += count;
    }
    EXPECT_GT(all, 400);
  }
}

TEST(photon_sheet, every_instruction_set_gathers_the_same_bits) {
  Photons photons = untidy_photons(20'000);
  for (std::size_t i = 0; i < photons.size(); ++i) photons.red[i] /= 7;  // so that sums round
  const PhotonMap map(photons, 0.1f, Threads(1));
  Gathers gathers(2000);
  for (const SheetTest test : {SheetTest::none, SheetTest::side, SheetTest::side_and_normal}) {
    const std::vector<SheetTest> tests{test, SheetTest::side_and_normal};
    const auto expected = gathers.gather(kernels_for("scalar"), map, 0.12f, tests);
    for (const Kernels& kernels : available_kernels()) {
      const auto flux = gathers.gather(kernels, map, 0.12f, tests);
      EXPECT_EQ(std::memcmp(flux.data(), expected.data(), flux.size() * sizeof flux[0]), 0) << kernels.isa;
    }
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_photons
