// Media that vary: their values at points, and estimates of flights through them against closed forms.
#include "renderer/media/varying_medium.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "renderer/lanes/test_chi_square.h"
#include "renderer/media/medium.h"

namespace photonproof::inline renderer_media {
namespace {

/// Values along x, each of one or three channels.
GridVolumeDescription along_x(std::vector<float> values, int channels = 1) {
  VolumeGrid grid;
  grid.channels = channels;
  grid.width = static_cast<int>(values.size()) / channels;
  for (const float v : values) grid.largest = std::max(grid.largest, v);
  grid.values = std::move(values);
  GridVolumeDescription volume;
  volume.grid = std::make_shared<const VolumeGrid>(std::move(grid));
  return volume;
}

float at_x(const GridVolumeDescription& grid, float x) { return Volume(grid, {}).at({x, 0.3f, 0.7f}).x; }

TEST(volume, interpolates_between_the_centres_of_cells) {
  // The centres are at 1/8, 3/8, 5/8 and 7/8.
  GridVolumeDescription grid = along_x({1, 2, 4, 8});
  EXPECT_FLOAT_EQ(at_x(grid, 0.375f), 2);
  EXPECT_FLOAT_EQ(at_x(grid, 0.5f), 3);
  EXPECT_FLOAT_EQ(at_x(grid, 0.75f), 6);
  EXPECT_FLOAT_EQ(at_x(grid, 0), 1);
  EXPECT_FLOAT_EQ(at_x(grid, 1), 8);
  EXPECT_FLOAT_EQ(at_x(grid, -7), 1);
  grid.filter = VolumeFilter::nearest;
  EXPECT_FLOAT_EQ(at_x(grid, 0.24f), 1);
  EXPECT_FLOAT_EQ(at_x(grid, 0.26f), 2);
  EXPECT_FLOAT_EQ(at_x(grid, 0.99f), 8);
}

TEST(volume, repeats_or_mirrors_beyond_its_cells) {
  GridVolumeDescription grid = along_x({1, 2, 4, 8});
  grid.wrap = TextureWrap::repeat;
  EXPECT_FLOAT_EQ(at_x(grid, 1), 4.5f) << "between 8 and 1";
  EXPECT_FLOAT_EQ(at_x(grid, 1.375f), 2);
  EXPECT_FLOAT_EQ(at_x(grid, -0.125f), 8);
  grid.wrap = TextureWrap::mirror;
  EXPECT_FLOAT_EQ(at_x(grid, 1), 8);
  EXPECT_FLOAT_EQ(at_x(grid, 1.375f), 4);
  EXPECT_FLOAT_EQ(at_x(grid, -0.375f), 2);
}

TEST(volume, lies_where_to_world_the_files_box_and_the_frame_put_it) {
  // Seven different numbers along x, y and z; the axes are told apart by their counts of cells.
  VolumeGrid cells;
  cells.width = 2;
  cells.height = 3;
  cells.depth = 4;
  cells.low = {-1, 0, 2};
  cells.high = {1, 3, 4};
  for (int i = 0; i < 24; ++i) cells.values.push_back(static_cast<float>(i));
  cells.largest = 23;
  GridVolumeDescription grid;
  grid.grid = std::make_shared<const VolumeGrid>(cells);
  grid.use_grid_bbox = true;
  grid.to_world = Transform::translate({10, 20, 30});
  // The cell (1, 2, 3) is 23, its centre 3/4, 5/6 and 7/8 of the box, at (0.5, 2.5, 3.75) + (10, 20, 30).
  EXPECT_NEAR(Volume(grid, {}).at({10.5f, 22.5f, 33.75f}).x, 23, 1e-3);
  // The cell (0, 1, 2) is 2 * (3 * 2 + 1) + 0 = 14, at (-0.5, 1.5, 3.25). The frame doubles, then moves by (-20, 0, 5).
  EXPECT_NEAR(Volume(grid, {{-20, 0, 5}, 2}).at({-1, 43, 71.5f}).x, 14, 1e-3);
  const Volume::Span span = Volume(grid, {}).inside({10, 21.5f, 0}, {0, 0, 1}, 1000);
  EXPECT_NEAR(span.begin, 32, 1e-3);
  EXPECT_NEAR(span.end, 34, 1e-3);
  EXPECT_NEAR(Volume(grid, {}).inside({10, 21.5f, 0}, {0, 0, 1}, 33).end, 33, 1e-3);
  const Volume::Span beside = Volume(grid, {}).inside({8.9f, 21.5f, 0}, {0, 0, 1}, 1000);
  EXPECT_GE(beside.begin, beside.end);
}

TEST(volume, ends_at_the_worlds_box_around_what_is_turned) {
  GridVolumeDescription grid;
  grid.grid = std::make_shared<const VolumeGrid>();
  grid.to_world = Transform::rotate({0, 0, 1}, 45);  // a square on its corner, from y = 0 to the square root of 2
  const Volume::Span span = Volume(grid, {}).inside({0.6f, -1, 0.5f}, {0, 1, 0}, 1000);
  EXPECT_NEAR(span.begin, 1, 1e-5);
  EXPECT_NEAR(span.end, 1 + std::sqrt(2.0), 1e-5);
}

/// Mean and standard error of a colour.
struct Mean {
  RgbD sum{0.0}, squares{0.0};
  double n = 0;
  void add(const Rgb& value) {
    const RgbD v(value);
    sum += v;
    squares += v * v;
    n += 1;
  }
  void expect(const RgbD& expected, const std::string& what) const {
    const std::array<double, 3> means = {sum.x, sum.y, sum.z}, sq = {squares.x, squares.y, squares.z},
                                right = {expected.x, expected.y, expected.z};
    for (std::size_t c = 0; c < 3; ++c) {
      const double mean = means[c] / n, error = std::sqrt((sq[c] / n - mean * mean) / n);
      EXPECT_NEAR(mean, right[c], 4 * error + 1e-6) << what << ", channel " << c;
      EXPECT_LT(error, 0.005 * right[c]) << what << ", channel " << c << " is too noisy to tell";
    }
  }
};

constexpr std::uint32_t flights = 500'000;
PathSampler draws(std::uint32_t index) { return draws_of_flight({SamplerKind::independent, 7, index}, 5); }

/// Extinction that grows along x from one cell to the next, another in every channel, times 1.5.
HeterogeneousDescription linear_cloud(double albedo) {
  return {along_x({0.1f, 0.4f, 2.0f, 1.1f, 0.2f, 0.0f}, 3), RgbD(albedo), 1.5, {}};
}
/// It is linear between x = 1/4 and 3/4 and constant beyond, so its mean over the unit cube is that of both cells. A
/// ray along (3, 4, 0)/5 from x = 0 to 1 is 5/3 long: T = exp(-1.5 (a + b) / 2 x 5/3).
const RgbD linear_transmittance{std::exp(-1.25 * 1.2), std::exp(-1.25 * 0.6), std::exp(-1.25 * 2.0)};
const Vec3f start{-0.6f, -1.1f, 0.4f}, along{0.6f, 0.8f, 0};

TEST(varying_medium, transmittance_of_a_linear_density_is_the_exponential_of_its_integral) {
  HeterogeneousDescription cloud = linear_cloud(0);
  std::get<GridVolumeDescription>(cloud.sigma_t).to_world = Transform::scale({1, 4, 1});
  // The ray meets the box x = 0..1, y = 0..4 at y = -0.3 and leaves by x = 1 at y = 1.03: begin it higher.
  const VaryingMedium medium(cloud, {});
  Mean ratio, flight;
  for (std::uint32_t i = 0; i < flights; ++i) {
    const Vec3f from = start + Vec3f(0, 1, 0);
    ratio.add(medium.transmittance(from, along, 100, draws(i)));
    const FreeFlight f = medium.fly(Rgb(0.2f, 1, 0.5f), from, along, 100, draws(i));
    ASSERT_FALSE(f.scattered);
    flight.add(f.weight);
  }
  ratio.expect(linear_transmittance, "ratio tracking");
  flight.expect(linear_transmittance, "flight");
}

TEST(varying_medium, ends_at_the_box_of_a_constant_extinction) {
  // Along (3, 4, 0)/5 the box from y = 2 to 4 is 2 / 0.8 long. In the unit cube, where the y of a ray from x = -0.6 is
  // -0.3 to 1.03, the ray would be 1.25 long.
  const ConstantVolumeDescription box{{0.2, 0.4, 0.1},
                                      Transform::translate({-9, 2, -9}) * Transform::scale({20, 2, 20})};
  const VaryingMedium medium({box, RgbD(0.0), 2, {}}, {});
  Mean passed;
  for (std::uint32_t i = 0; i < flights; ++i) passed.add(medium.transmittance(start, along, 100, draws(i)));
  passed.expect({std::exp(-1.0), std::exp(-2.0), std::exp(-0.5)}, "2.5 x 2 sigma_t");
}

TEST(varying_medium, scatters_its_albedo_of_what_does_not_pass) {
  // The integral of albedo sigma_t T over the way is albedo (1 - T), in every channel and for any throughput.
  HeterogeneousDescription cloud = linear_cloud(0.8);
  std::get<GridVolumeDescription>(cloud.sigma_t).to_world = Transform::scale({1, 4, 1});
  const VaryingMedium medium(cloud, {});
  for (const Rgb& throughput : {Rgb(1, 1, 1), Rgb(0.05f, 1, 0.3f)}) {
    Mean scattered, passed;
    for (std::uint32_t i = 0; i < flights; ++i) {
      const FreeFlight f = medium.fly(throughput, start + Vec3f(0, 1, 0), along, 100, draws(i));
      scattered.add(f.scattered ? f.weight : Rgb(0.0f));
      passed.add(f.scattered ? Rgb(0.0f) : f.weight);
      ASSERT_LE(dot(throughput, f.weight), (throughput.x + throughput.y + throughput.z) * 1.00001f) << "it grows";
    }
    passed.expect(linear_transmittance, "passed");
    scattered.expect((RgbD(1.0) - linear_transmittance) * 0.8, "scattered");
  }
}

TEST(varying_medium, ends_at_its_box_and_at_the_distance) {
  // In the unit cube, sigma_t = 1, along z: from z = 0 to 1 of an endless ray, and from z = 0 to 0.4 of a short one.
  const VaryingMedium medium({RgbD(1), RgbD(0), 1, {}}, {});
  Mean whole, part;
  for (std::uint32_t i = 0; i < flights; ++i) {
    whole.add(medium.transmittance({0.5f, 0.5f, -3}, {0, 0, 1}, std::numeric_limits<float>::infinity(), draws(i)));
    part.add(medium.transmittance({0.5f, 0.5f, -3}, {0, 0, 1}, 3.4f, draws(i)));
    ASSERT_EQ(medium.transmittance({1.5f, 0.5f, -3}, {0, 0, 1}, 100, draws(i)), Rgb(1.0f));
  }
  whole.expect(RgbD(std::exp(-1.0)), "box");
  part.expect(RgbD(std::exp(-0.4)), "distance");
}

TEST(varying_medium, draws_are_of_one_flight_alone) {
  const PathSampler path{SamplerKind::independent, 3, 9};
  EXPECT_NE(draws_of_flight(path, 1).one(0), draws_of_flight(path, 2).one(0));
  EXPECT_NE(draws_of_flight(path, 1).one(1), draws_of_flight(path, 2).one(0));
  EXPECT_NE(draws_of_flight(path, 1).one(1), path.one(1));
}

TEST(phase_function, draws_by_its_density) {
  const Vec3f travel = normalize(Vec3f(0.3f, -0.5f, 0.8f));
  for (const PhaseFunction& phase :
       {PhaseFunction{Rayleigh{}, {}, 0}, PhaseFunction{HenyeyGreenstein{0.7f}, Rayleigh{}, 0.4f},
        PhaseFunction{HenyeyGreenstein{0.7f}, HenyeyGreenstein{-0.5f}, 1}}) {
    const double p_value =
        test::direction_p_value([&](test::Random& random) { return phase.sample(travel, random.next2()); },
                                [&](const Vec3f& d) { return phase.eval(travel, d); }, 11);
    EXPECT_GT(p_value, test::sidak_level(3));
  }
}

TEST(phase_function, has_the_shares_of_its_formula) {
  const Vec3f travel(0, 0, 1), ahead(0, 0, 1), beside(1, 0, 0);
  const PhaseFunction rayleigh{Rayleigh{}, {}, 0};
  EXPECT_FLOAT_EQ(rayleigh.eval(travel, ahead), 3 / (8 * pi));
  EXPECT_FLOAT_EQ(rayleigh.eval(travel, beside), 3 / (16 * pi));
  const PhaseFunction blend{HenyeyGreenstein{}, Rayleigh{}, 0.25f};
  EXPECT_FLOAT_EQ(blend.eval(travel, ahead), 0.75f / (4 * pi) + 0.25f * 3 / (8 * pi));
}

/// A medium of the same extinction everywhere within a scene.
Medium compiled(const HomogeneousDescription& d, const VolumeFrame& frame = {}) {
  SceneDescription scene;
  scene.media.push_back({{}, "", d});
  return compile_media(scene, frame).media.at(0);
}

TEST(homogeneous_medium, scatters_the_albedo_of_the_place) {
  // Along x from 0 to 4 the albedo is 0.2 up to x = 2 and 0.8 beyond, in red; half of that in green and 1 in blue. What
  // scatters is the sum of albedo (T at the beginning - T at the end).
  GridVolumeDescription steps = along_x({0.2f, 0.1f, 1.0f, 0.8f, 0.4f, 1.0f}, 3);
  steps.filter = VolumeFilter::nearest;
  steps.to_world = Transform::scale(Vec3d(4));
  const RgbD sigma_t{0.5, 0.25, 1};
  const Medium medium = compiled({sigma_t, steps, 1, {}});
  EXPECT_TRUE(medium.scatters);
  Mean scattered;
  const Rgb throughput{0.7f, 0.2f, 1.0f};
  for (std::uint32_t i = 0; i < flights; ++i) {
    const PathSampler draw = draws(i);
    const FreeFlight flight = fly(medium, throughput, {0, 0.5f, 0.5f}, {1, 0, 0}, 4, draw.one(0), draw.one(1));
    scattered.add(flight.scattered ? flight.weight : Rgb(0.0f));
  }
  const auto first = [](double s) { return 1 - std::exp(-2 * s); };
  const auto second = [](double s) { return std::exp(-2 * s) - std::exp(-4 * s); };
  scattered.expect({0.2 * first(0.5) + 0.8 * second(0.5), 0.1 * first(0.25) + 0.4 * second(0.25), first(1) + second(1)},
                   "scattered");
  const GridVolumeDescription black = along_x({0, 0});
  EXPECT_FALSE(compiled({sigma_t, black, 1, {}}).scatters);
}

TEST(phase_functions, are_blended_by_the_weight_of_the_place) {
  // The weight is 1/4 at x = 1 and 3/4 at x = 3, linear between; the frame doubles.
  GridVolumeDescription weight = along_x({0.25f, 0.75f});
  weight.to_world = Transform::scale(Vec3d(2));
  const BlendPhaseDescription blend{weight, HenyeyGreensteinDescription{0.5}, IsotropicDescription{}};
  const Medium medium = compiled({RgbD(1), RgbD(1), 1, blend}, {{}, 2});
  const Vec3f travel(0, 0, 1), aside(1, 0, 0);
  const double forward = (1 - 0.25) / (4 * std::numbers::pi * 1.25 * std::sqrt(1.25)),
               even = 1 / (4 * std::numbers::pi);
  for (const auto& [x, share] : {std::pair(0.5f, 0.25), {1.0f, 0.25}, {2.0f, 0.5}, {3.5f, 0.75}})
    EXPECT_NEAR(medium.phase_at({x, 0, 0}).eval(travel, aside), (1 - share) * forward + share * even, 1e-6) << x;
}

}  // namespace
}  // namespace photonproof::inline renderer_media
