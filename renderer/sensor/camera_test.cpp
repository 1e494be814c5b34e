// Cameras of every kind: the connection from the scene is the inverse of the rays, importance is a density of the
// raster, and filters are sampled as they are evaluated.

#include "renderer/sensor/camera.h"

#include <gtest/gtest.h>

#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "renderer/kernels/camera_rays.h"
#include "renderer/lanes/test_chi_square.h"
#include "renderer/sensor/camera_connection.h"
#include "renderer/sensor/reconstruction_filter.h"
#include "renderer/sensor/splats.h"

namespace photonproof::inline renderer_sensor {
namespace {

using test::Random;

constexpr int image_width = 30, image_height = 20;

struct Named {
  const char* name;
  decltype(SensorDescription::camera) camera;
  Transform scaled;  ///< to_world's innermost part
};

std::vector<Named> cameras() {
  PerspectiveDescription shifted;
  shifted.fov_degrees = 70;
  shifted.principal_x = 0.1;
  shifted.principal_y = -0.2;
  return {{"perspective", PerspectiveDescription{}, {}},
          {"shifted", shifted, {}},
          {"thinlens", ThinLensDescription{PerspectiveDescription{}, 0.2, 3}, {}},
          {"orthographic", OrthographicDescription{}, Transform::scale({3, 2, 1})},
          {"fisheye", FisheyeDescription{200, 1e-2, 1e4}, {}}};
}

CameraView view_of(const Named& named) {
  SensorDescription sensor;
  sensor.camera = named.camera;
  sensor.to_world = Transform::look_at({1, 2, 3}, {-2, 1, 0}, {0.1, 1, 0}) * named.scaled;
  sensor.film.width = image_width;
  sensor.film.height = image_height;
  return compile_camera(sensor, image_width, image_height, {});
}

TEST(cameras, the_way_back_is_the_inverse_of_the_ray) {
  for (const Named& named : cameras()) {
    const CameraView camera = view_of(named);
    int checked = 0;
    for (std::uint64_t i = 0; i < 5000; ++i) {
      Random r(400, i);
      const Vec2<float> raster{r.next() * image_width, r.next() * image_height};
      const Vec2<float> u_lens = r.next2();
      CameraRay<float> ray;
      set_ray<float>(camera, raster, u_lens, ray);
      if (!ray.valid) continue;
      const Vec3f p = ray.origin + ray.direction * (0.5f + 5 * r.next());
      const CameraConnection c = connect_to_camera(camera, p, u_lens);
      ASSERT_TRUE(c.visible) << named.name;
      EXPECT_NEAR(c.raster.x, raster.x, 2e-3f) << named.name;
      EXPECT_NEAR(c.raster.y, raster.y, 2e-3f) << named.name;
      EXPECT_NEAR(length(c.direction - ray.direction), 0, 1e-5f) << named.name;
      EXPECT_NEAR(length(c.origin - ray.origin), 0, 1e-4f) << named.name;
      EXPECT_NEAR(c.distance, length(p - ray.origin), 1e-4f) << named.name;
      ++checked;
    }
    EXPECT_GT(checked, 2000) << named.name;
  }
}

TEST(cameras, importance_is_the_raster_area_an_area_across_the_ray_covers) {
  // The Jacobian by differences: the parallelogram of two small steps across the ray, on the raster.
  for (const Named& named : cameras()) {
    const CameraView camera = view_of(named);
    for (std::uint64_t i = 0; i < 200; ++i) {
      Random r(410, i);
      const Vec2<float> u_lens = r.next2();
      CameraRay<float> ray;
      set_ray<float>(camera, {(0.1f + 0.8f * r.next()) * image_width, (0.1f + 0.8f * r.next()) * image_height}, u_lens,
                     ray);
      if (!ray.valid) continue;
      const Vec3f p = ray.origin + ray.direction * 2.0f;
      const CameraConnection c = connect_to_camera(camera, p, u_lens);
      if (!c.visible) continue;
      const Frame<float> frame(ray.direction);
      constexpr float step = 4e-3f;
      const auto at = [&](const Vec3f& moved) { return connect_to_camera(camera, p + moved, u_lens).raster; };
      const Vec2<float> a = at(frame.s * step), b = at(frame.s * -step), d = at(frame.t * step),
                        e = at(frame.t * -step);
      const float area = std::abs((a.x - b.x) * (d.y - e.y) - (a.y - b.y) * (d.x - e.x)) / (4 * step * step);
      EXPECT_NEAR(area, c.importance, 0.02f * c.importance) << named.name;
    }
  }
}

TEST(cameras, importance_integrates_to_the_pixels_of_the_image) {
  // Raster area per solid angle is importance times the square of the distance to the lens, over the directions through
  // raster points inside the image. The orthographic camera has raster area per area: only to_world's (3, 2) scales
  // 6 x 4, so the width is 6, the height 2 x 2 x 20/30.
  constexpr double pixels = image_width * image_height;
  for (const Named& named : cameras()) {
    const CameraView camera = view_of(named);
    if (camera.kind == CameraKind::orthographic) {
      const CameraConnection c = connect_to_camera(camera, camera.origin + camera.forward * 2.0f, {0.5f, 0.5f});
      EXPECT_NEAR(pixels / double{c.importance}, 6 * 4 * 2 / 3.0, 1e-4);
      continue;
    }
    const auto density = [&](double z, double phi) {
      const double r = std::sqrt(std::max(1 - z * z, 0.0));
      const Vec3f d(Vec3d(r * std::cos(phi), r * std::sin(phi), z));
      const CameraConnection c = connect_to_camera(camera, camera.origin + d * 2.0f, {0.5f, 0.5f});
      return c.visible ? double{c.importance} * 4 / pixels : 0.0;
    };
    double sum = 0;
    constexpr int cells = 60;
    for (int row = 0; row < cells; ++row)
      for (int column = 0; column < cells; ++column)
        sum += test::integrate_rectangle(density, 2.0 * row / cells - 1, 2 * std::numbers::pi * column / cells,
                                         2.0 / cells, 2 * std::numbers::pi / cells, 5);
    // A fisheye's circle fills pi/4 of a square of 20 x 20 pixels; u_lens (0.5, 0.5) is the lens's middle.
    const double image = camera.kind == CameraKind::fisheye ? std::numbers::pi / 4 * 400 / 600 : 1;
    EXPECT_NEAR(sum, image, 2e-3 * image) << named.name;
  }
}

TEST(cameras, the_principal_point_moves_pixels_by_its_share_of_the_film) {
  PerspectiveDescription camera;
  camera.principal_x = 0.1;  // 3 of 30 pixels
  camera.principal_y = -0.2;
  CameraRay<float> plain, moved;
  set_ray<float>(view_of({"", PerspectiveDescription{}, {}}), {10, 10}, {}, plain);
  set_ray<float>(view_of({"", camera, {}}), {7, 14}, {}, moved);
  EXPECT_NEAR(length(plain.direction - moved.direction), 0, 1e-6f);
}

TEST(cameras, the_field_of_view_is_along_its_axis) {
  // 60 degrees from edge to edge, or corner to corner, of an image wide or high. The middle of an edge is seen at
  // tan 30 degrees off the axis, times the ratio of the sides, or of side and diagonal.
  const double t = std::tan(std::numbers::pi / 6);
  for (const auto& [width, height] : {std::pair{40, 20}, std::pair{20, 40}}) {
    const double diagonal = std::hypot(width, height), smaller = std::min(width, height),
                 larger = std::max(width, height);
    for (const auto& [axis, side] : {std::pair<FovAxis, double>{FovAxis::x, width},
                                     {FovAxis::y, height},
                                     {FovAxis::diagonal, diagonal},
                                     {FovAxis::smaller, smaller},
                                     {FovAxis::larger, larger}}) {
      PerspectiveDescription perspective;
      perspective.fov_degrees = 60;
      perspective.fov_axis = axis;
      SensorDescription sensor;
      sensor.camera = perspective;
      const CameraView camera = compile_camera(sensor, width, height, {});
      CameraRay<float> left, top;
      set_ray<float>(camera, {0, static_cast<float>(height) / 2}, {}, left);
      set_ray<float>(camera, {static_cast<float>(width) / 2, 0}, {}, top);
      EXPECT_NEAR(left.direction.x / left.direction.z, t * width / side, 1e-5) << width << " " << int(axis);
      EXPECT_NEAR(top.direction.y / top.direction.z, t * height / side, 1e-5) << width << " " << int(axis);
    }
  }
}

TEST(cameras, a_thin_lens_is_sharp_at_its_distance) {
  const CameraView camera = view_of(cameras()[2]);
  CameraRay<float> a, b;
  set_ray<float>(camera, {11, 4}, {0.1f, 0.9f}, a);
  set_ray<float>(camera, {11, 4}, {0.8f, 0.2f}, b);
  const auto sharp = [&](const CameraRay<float>& ray) {
    const float t = (3 - dot(ray.origin - camera.origin, camera.forward)) / dot(ray.direction, camera.forward);
    return ray.origin + ray.direction * t;
  };
  EXPECT_NEAR(length(sharp(a) - sharp(b)), 0, 1e-5f);
  EXPECT_GT(length(a.origin - b.origin), 0.1f);
}

TEST(cameras, an_orthographic_film_spans_local_x_from_one_to_minus_one) {
  // Left is +x; rays start on the near plane and are parallel. Height follows the aspect: y from 2/3 to -2/3.
  SensorDescription sensor;
  sensor.camera = OrthographicDescription{};
  const CameraView camera = compile_camera(sensor, image_width, image_height, {});
  CameraRay<float> ray;
  set_ray<float>(camera, {0, 0}, {}, ray);
  EXPECT_NEAR(ray.origin.x, 1, 1e-6f);
  EXPECT_NEAR(ray.origin.y, 2 / 3.0f, 1e-6f);
  EXPECT_NEAR(ray.origin.z, 0.01f, 1e-6f);
  EXPECT_EQ(ray.direction, Vec3f(0, 0, 1));
}

TEST(cameras, a_fisheyes_angle_grows_with_the_distance_from_the_middle) {
  SensorDescription sensor;
  sensor.camera = FisheyeDescription{180, 1e-2, 1e4};
  const CameraView camera = compile_camera(sensor, image_width, image_height, {});
  CameraRay<float> ray;
  set_ray<float>(camera, {15, 5}, {}, ray);  // half way up: 45 degrees
  EXPECT_NEAR(ray.direction.y, std::sqrt(0.5f), 1e-6f);
  EXPECT_NEAR(ray.direction.z, std::sqrt(0.5f), 1e-6f);
  set_ray<float>(camera, {2, 10}, {}, ray);
  EXPECT_FALSE(ray.valid);
}

// --- filters ---------------------------------------------------------------------------------------------------------

std::vector<ReconstructionFilter> filters() {
  using Kind = ReconstructionFilter::Kind;
  return {{Kind::tent, 0.5, 1}, {Kind::tent, 0.5, 2.5}, {Kind::gaussian, 0.5, 1}, {Kind::gaussian, 0.8, 1}};
}

TEST(filters, offsets_are_drawn_as_the_filter_weighs) {
  for (const ReconstructionFilter& filter : filters()) {
    const FilterKernel kernel(filter);
    const FilterView view = compile_filter(filter, true);
    constexpr int cells = 64, samples = 1'000'000;
    std::vector<double> observed(cells), expected(cells);
    double mean_square = 0;
    for (int i = 0; i < samples; ++i) {
      const double x = double{filter_offset(view, Random(430, static_cast<std::uint64_t>(i)).next())};
      ASSERT_LE(std::abs(x), kernel.radius() * (1 + 1e-6));
      mean_square += x * x / samples;
      observed[static_cast<std::size_t>(
          std::clamp(static_cast<int>((x / kernel.radius() + 1) / 2 * cells), 0, cells - 1))] += 1;
    }
    const auto cumulative = [&](double x) { return x < 0 ? -kernel.half_integral(-x) : kernel.half_integral(x); };
    double second_moment = 0;
    for (int i = 0; i < cells; ++i) {
      const double a = (2.0 * i / cells - 1) * kernel.radius(), b = (2.0 * (i + 1) / cells - 1) * kernel.radius();
      expected[static_cast<std::size_t>(i)] = samples * (cumulative(b) - cumulative(a));
    }
    constexpr int steps = 20'000;
    for (int i = 0; i < steps; ++i) {
      const double x = (2 * (i + 0.5) / steps - 1) * kernel.radius();
      second_moment += x * x * kernel(x) * 2 * kernel.radius() / steps;
    }
    EXPECT_GT(test::chi_square_p_value(observed, expected), test::sidak_level(4));
    EXPECT_NEAR(mean_square, second_moment, 0.005 * second_moment);
    EXPECT_NEAR(kernel.half_integral(1e3), 0.5, 1e-12);
  }
}

TEST(filters, offsets_at_the_border_are_drawn_as_the_filter_weighs_within_the_film) {
  // The density of the pixel `at` of `size` is the filter's between the film's borders, over its integral there.
  constexpr int cells = 64, samples = 200'000;
  int kinds = 0;
  for (const ReconstructionFilter& filter : filters())
    for (const auto& [at, size] : {std::pair{0, 30}, {1, 30}, {29, 30}, {0, 1}, {1, 3}}) {
      const FilterKernel kernel(filter);
      const FilterView view = compile_filter(filter, false);
      const double left = std::max(-kernel.radius(), -(at + 0.5)), right = std::min(kernel.radius(), size - at - 0.5);
      const auto cumulative = [&](double x) { return x < 0 ? -kernel.half_integral(-x) : kernel.half_integral(x); };
      std::vector<double> observed(cells), expected(cells);
      for (int i = 0; i < cells; ++i)
        expected[static_cast<std::size_t>(i)] =
            samples *
            (cumulative(left + (right - left) * (i + 1) / cells) - cumulative(left + (right - left) * i / cells)) /
            (cumulative(right) - cumulative(left));
      for (int i = 0; i < samples; ++i) {
        const double x = double{filter_offset<float>(view, static_cast<std::uint32_t>(at), static_cast<float>(size),
                                                     Random(440, static_cast<std::uint64_t>(i)).next())};
        ASSERT_GE(x, left - 1e-5);
        ASSERT_LE(x, right + 1e-5);
        observed[static_cast<std::size_t>(
            std::clamp(static_cast<int>((x - left) / (right - left) * cells), 0, cells - 1))] += 1;
      }
      EXPECT_GT(test::chi_square_p_value(observed, expected), test::sidak_level(20)) << at << " " << size;
      EXPECT_NEAR(kernel.integral_within(at, size), cumulative(right) - cumulative(left), 1e-12);
      ++kinds;
    }
  EXPECT_EQ(kinds, 20);
}

TEST(filters, offsets_away_from_the_border_have_the_bits_of_a_film_without_one) {
  const ReconstructionFilter filter{ReconstructionFilter::Kind::gaussian, 0.5, 1};
  const FilterView with = compile_filter(filter, true), without = compile_filter(filter, false);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const float u = Random(450, i).next();
    EXPECT_EQ(filter_offset<float>(without, 2u, 30.0f, u), filter_offset(with, u));
  }
}

TEST(filters, splats_within_the_film_give_every_pixel_one_at_its_border_too) {
  for (const ReconstructionFilter& filter : filters()) {
    constexpr int steps = 40, size = 6;
    SplatImage image({0, 0, size, size}, filter, size, size);
    Splats splats;
    for (int i = 0; i < steps * size; ++i)
      for (int j = 0; j < steps * size; ++j)
        splats.push_back({{(static_cast<float>(i) + 0.5f) / steps, (static_cast<float>(j) + 0.5f) / steps}, Rgb(1.0f)});
    image.add(splats);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) EXPECT_NEAR(image.sum(x, y).x / (steps * steps), 1, 3e-3) << x << " " << y;
  }
}

TEST(filters, splats_of_evenly_spread_points_give_every_pixel_one) {
  std::vector<ReconstructionFilter> all = filters();
  all.push_back({ReconstructionFilter::Kind::box, 0.5, 1});
  for (const ReconstructionFilter& filter : all) {
    const FilterKernel kernel(filter);
    double sum = 0, pixel = 0;
    constexpr int steps = 40, size = 15;
    for (int i = 0; i < steps * size; ++i)
      for (int j = 0; j < steps * size; ++j)
        kernel.for_each_pixel({(static_cast<float>(i) + 0.5f) / steps, (static_cast<float>(j) + 0.5f) / steps}, size,
                              size, [&](int x, int y, float weight) {
                                if (x == 7 && y == 7) pixel += double{weight};
                                sum += double{weight};
                              });
    EXPECT_NEAR(pixel / (steps * steps), 1, 2e-3);
    EXPECT_LE(sum / (steps * steps), size * size * 1.001);
  }
}

TEST(filters, a_box_splat_falls_into_the_pixel_that_holds_it) {
  const FilterKernel box(ReconstructionFilter{ReconstructionFilter::Kind::box, 0.5, 1});
  EXPECT_NEAR(box.pixels_a_splat(), 1, 1e-9);
  // The integral of the tent's w^2 is 2/3 along an axis.
  EXPECT_NEAR(FilterKernel(ReconstructionFilter{ReconstructionFilter::Kind::tent, 0.5, 1}).pixels_a_splat(), 2.25,
              1e-4);
  for (const Vec2<float> at : {Vec2<float>{3.0f, 4.5f}, Vec2<float>{3.999f, 4.0f}}) {
    int count = 0;
    box.for_each_pixel(at, 10, 10, [&](int x, int y, float weight) {
      EXPECT_EQ(x, 3);
      EXPECT_EQ(y, 4);
      EXPECT_EQ(weight, 1);
      ++count;
    });
    EXPECT_EQ(count, 1);
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_sensor
