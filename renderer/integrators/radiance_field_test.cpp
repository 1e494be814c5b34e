// The radiance field of ellipsoids against closed forms, and its spherical harmonics.
#include "renderer/integrators/radiance_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/integrators/check_supported.h"
#include "renderer/integrators/harmonics.h"
#include "renderer/integrators/test_scenes.h"
#include "scenes/base/srgb.h"

namespace photonproof::inline renderer_integrators {
namespace {

constexpr int pixels = 16;
constexpr float flat = 0.28209479f;  ///< the harmonic of degree 0

/// A cloud of Gaussians whose colours are the same in all directions.
struct Cloud {
  std::shared_ptr<EllipsoidCloud> made = std::make_shared<EllipsoidCloud>();
  void add(const Ellipsoid& e, float opacity, const Rgb& colour) {
    made->ellipsoids.push_back(e);
    made->opacities.push_back(opacity);
    made->harmonics.push_back((colour - Rgb(0.5f)) * (1 / flat));
    made->coefficients = 1;
  }
};

RadianceFieldDescription linear() {
  RadianceFieldDescription method;
  method.srgb_primitives = false;
  return method;
}

/// Seen along -z, or +z from `behind`.
SceneDescription scene_of(const Cloud& cloud, const RadianceFieldDescription& method = linear(), bool behind = false) {
  SceneDescription scene;
  EllipsoidsDescription d;
  d.filename = "a.ply";
  d.cloud = cloud.made;
  test::add_shape(scene, d, {}, test::add_bsdf(scene, DiffuseDescription{}));
  test::set_camera(scene, Transform::look_at({0, 0, behind ? -5.0 : 5.0}, {0, 0, 0}, {0, 1, 0}), 40, pixels);
  scene.sensor.camera = OrthographicDescription{};
  scene.integrator.method = method;
  return scene;
}

/// Radiance at the middle of each pixel.
Image middles(const SceneDescription& scene) {
  RenderJob job = test::job_with(1);
  job.grid = 1;
  return test::render(scene, "volprim_rf_basic", job).image.mean;
}

/// Calls check(pixel, x, y) with the place in the scene that the pixel's middle sees.
template <class Check>
void for_pixels(const SceneDescription& description, const Image& image, Check&& check) {
  const Scene scene = test::compiled(description, pixels, pixels);
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x) {
      const Vec3d p = Vec3d(test::ray_through_pixel(scene.view(), x, y).origin) - scene.frame.moved;
      const float* rgb = &image.rgb[3 * static_cast<std::size_t>(y * pixels + x)];
      check(Vec3d(double{rgb[0]}, double{rgb[1]}, double{rgb[2]}), p.x, p.y);
    }
}

// The largest value of exp(-q.S^-1.q / 2) along z is exp(-r.P^-1.r / 2), P being the first two rows and columns of S.
// S is R diag(s^2) R^T, where s = (.5, .2, .3) and R turns by 60 degrees about a = (1, 1, 0) / sqrt(2). The matrix R is
// c I + (1 - c) a a^T + sin [a]x, of the cosine c.
TEST(radiance_field, of_a_gaussian_is_its_projection) {
  const double c = 0.5, s = std::sqrt(3.0) / 2, k = s / std::numbers::sqrt2;
  const double r[2][3] = {{c + (1 - c) / 2, (1 - c) / 2, k}, {(1 - c) / 2, c + (1 - c) / 2, -k}};
  const double scale[3] = {0.5, 0.2, 0.3};
  double p[2][2] = {};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int n = 0; n < 3; ++n) p[i][j] += r[i][n] * r[j][n] * scale[n] * scale[n];
  const double determinant = p[0][0] * p[1][1] - p[0][1] * p[1][0];
  Cloud cloud;
  const float axis = static_cast<float>(0.5 / std::numbers::sqrt2);  // half a turn's sine is 1/2
  cloud.add({{0.1f, -0.2f, 0}, {0.5f, 0.2f, 0.3f}, {axis, axis, 0, static_cast<float>(s)}}, 0.7f, {1, 0.5f, 0.25f});
  const SceneDescription scene = scene_of(cloud);
  double sum = 0;
  for_pixels(scene, middles(scene), [&](const Vec3d& rgb, double x, double y) {
    const double u = x - 0.1, v = y + 0.2;
    const double form = (u * u * p[1][1] - 2 * u * v * p[0][1] + v * v * p[0][0]) / determinant;
    const double weight = form < 9 ? 0.7 * std::exp(-form / 2) : 0;
    if (std::abs(form - 9) < 1e-3) return;
    EXPECT_NEAR(rgb.x, weight, 2e-6);
    EXPECT_NEAR(rgb.y, weight * 0.5, 2e-6);
    EXPECT_NEAR(rgb.z, weight * 0.25, 2e-6);
    sum += rgb.x;
  });
  EXPECT_GT(sum, 5);
}

TEST(radiance_field, is_the_same_at_any_size) {
  const auto image_at = [](double unit) {
    const auto u = static_cast<float>(unit);
    Cloud cloud;
    cloud.add({{0.2f * u, 0, -u}, {0.9f * u, 0.5f * u, 0.1f * u}}, 0.8f, {0, 1, 0.5f});
    cloud.add({{0, 0.1f * u, u}, {0.3f * u, 0.3f * u, 0.2f * u}, {0.6f, 0, 0, 0.8f}}, 0.6f, {1, 0, 0.5f});
    SceneDescription scene = scene_of(cloud);
    test::set_camera(scene, Transform::look_at({0, 0, 5 * unit}, {0, 0, 0}, {0, 1, 0}), 40, pixels);
    scene.sensor.camera = PerspectiveDescription{.fov_degrees = 40, .near_clip = 0.01 * unit, .far_clip = 100 * unit};
    return middles(scene);
  };
  const Image expected = image_at(1);
  ASSERT_GT(test::image_mean(expected), 0.05);
  for (const int exponent : {-15, -9, -4, 5, 10, 15}) {
    const Image image = image_at(std::pow(10.0, exponent));
    for (std::size_t i = 0; i < expected.rgb.size(); ++i)
      ASSERT_NEAR(image.rgb[i], expected.rgb[i], 1e-5) << "1e" << exponent << " " << i;
  }
}

// Gaussians at z = 1 and -1, the second wide enough that pixels see both.
TEST(radiance_field, of_two_is_blended_in_order) {
  Cloud cloud;
  cloud.add({{0, 0, -1}, {0.9f, 0.9f, 0.1f}}, 0.8f, {0, 1, 0});
  cloud.add({{0, 0, 1}, {0.3f, 0.3f, 0.3f}}, 0.6f, {1, 0, 0});
  for (const bool behind : {false, true}) {
    const SceneDescription scene = scene_of(cloud, linear(), behind);
    for_pixels(scene, middles(scene), [&](const Vec3d& rgb, double x, double y) {
      const double r2 = x * x + y * y;
      const double near = r2 < 0.81 ? 0.6 * std::exp(-r2 / (2 * 0.09)) : 0, far = 0.8 * std::exp(-r2 / (2 * 0.81));
      if (std::abs(r2 - 0.81) < 1e-3) return;
      EXPECT_NEAR(rgb.x, behind ? (1 - far) * near : near, 2e-6);
      EXPECT_NEAR(rgb.y, behind ? far : (1 - near) * far, 2e-6);
    });
  }
}

// The large one is entered first, though its centre is the farther one.
TEST(radiance_field, orders_by_where_rays_enter) {
  Cloud cloud;
  cloud.add({{0, 0, 0}, {2, 2, 1}}, 0.5f, {1, 0, 0});
  cloud.add({{0, 0, 1}, {2, 2, 0.1f}}, 0.5f, {0, 1, 0});
  const Image image = middles(scene_of(cloud));
  const std::size_t middle = 3 * (pixels / 2 * pixels + pixels / 2);
  EXPECT_NEAR(image.rgb[middle], 0.5, 2e-3);
  EXPECT_NEAR(image.rgb[middle + 1], 0.25, 2e-3);
}

// Weights are at most .9999. After 7 of 1/2 less than 1 % is left, so the eighth is not seen.
TEST(radiance_field, ends_where_little_is_left_or_at_max_depth) {
  const auto middle_of = [](float opacity, int count, int max_depth, bool triangles = false) {
    Cloud cloud;
    for (int i = 0; i < count; ++i) cloud.add({{0, 0, static_cast<float>(-i)}, {50, 50, 0.1f}}, opacity, Rgb(1));
    RadianceFieldDescription method = linear();
    method.max_depth = max_depth;
    SceneDescription scene = scene_of(cloud, method);
    std::get<EllipsoidsDescription>(scene.shapes[0].geometry).triangles = triangles;
    return double{middles(scene).rgb[3 * (pixels / 2 * pixels + pixels / 2)]};
  };
  EXPECT_NEAR(middle_of(1, 2, -1), 0.9999, 1e-5);
  EXPECT_NEAR(middle_of(0.5f, 50, -1), 1 - std::pow(0.5, 7), 1e-5);
  EXPECT_NEAR(middle_of(0.5f, 50, 3), 1 - std::pow(0.5, 3), 1e-5);
  EXPECT_NEAR(middle_of(0.5f, 2, 3), 1 - std::pow(0.5, 2), 1e-5);
  EXPECT_NEAR(middle_of(0.01f, 100, -1), 1 - std::pow(0.99, 100), 1e-4) << "more than one traversal finds";
  EXPECT_NEAR(middle_of(0.01f, 100, 64), 1 - std::pow(0.99, 64), 1e-4);
  EXPECT_NEAR(middle_of(0.01f, 100, -1, true), 1 - std::pow(0.99, 100), 1e-4);
  EXPECT_EQ(RadianceFieldDescription{}.max_depth, 64);
}

TEST(radiance_field, is_made_linear_after_blending) {
  Cloud cloud;
  cloud.add({{0, 0, 1}, {50, 50, 0.1f}}, 0.5f, {0.2f, 0.6f, 3});
  cloud.add({{0, 0, 0}, {50, 50, 0.1f}}, 0.5f, {0.8f, 0.04f, 0});
  const Image image = middles(scene_of(cloud, RadianceFieldDescription{}));
  const double blended[3] = {0.1 + 0.2, 0.3 + 0.01, 1.5};
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(image.rgb[3 * (pixels / 2 * pixels + pixels / 2) + c], decode_srgb(blended[c]), 2e-5);
}

TEST(radiance_field, is_black_at_other_surfaces_and_around_the_camera) {
  Cloud cloud;
  cloud.add({{0, 0, 0}, {500, 500, 0.1f}}, 0.5f, Rgb(1));
  cloud.add({{0, 0, 5}, {500, 500, 0.1f}}, 0.5f, Rgb(1));
  SceneDescription scene = scene_of(cloud);
  EXPECT_THAT(middles(scene).rgb, testing::Each(testing::FloatNear(0.5f, 1e-4f)));
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(1)}});
  test::add_shape(scene, RectangleDescription{}, Transform::translate({0, 0, 1}) * Transform::scale(Vec3d(9)), {0});
  EXPECT_THAT(middles(scene).rgb, testing::Each(0));
  scene.shapes.erase(scene.shapes.begin());
  EXPECT_THAT(middles(scene).rgb, testing::Each(0));
}

TEST(radiance_field, has_the_same_bits_at_any_number_of_threads) {
  Cloud cloud;
  for (int i = 0; i < 200; ++i) {
    const auto at = [i](int k) { return static_cast<float>(std::sin(i * 1.7 + k * 2.1)); };
    cloud.add({{at(0), at(1), at(2)}, {0.2f, 0.1f, 0.3f}}, 0.3f, {0.5f + at(3) / 2, 0.4f, 0.7f});
  }
  test::expect_same_bits_at_any_threads(scene_of(cloud), "volprim_rf_basic", test::job_with(4));
}

TEST(radiance_field, of_a_cloud_without_colours_is_refused) {
  Cloud cloud;
  cloud.add({{0, 0, 0}, {1, 1, 1}}, 0.5f, Rgb(1));
  cloud.made->harmonics.clear();
  const SceneDescription scene = scene_of(cloud);
  try {
    check_supported(scene, scene.integrator);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.summary(), testing::HasSubstr("needs opacities and spherical harmonics, which 'a.ply' lacks"));
  }
}

// The polynomials of degrees 0 to 3 as 3D Gaussian splatting has them.
TEST(harmonics, are_those_of_gaussian_splatting) {
  const Harmonics harmonics(16);
  for (int i = 0; i < 50; ++i) {
    const Vec3d d = normalize(Vec3d{std::sin(1.0 * i), std::sin(2.3 * i + 1), std::cos(0.7 * i)});
    const double x = d.x, y = d.y, z = d.z;
    const double expected[16] = {0.28209479177387814,
                                 -0.4886025119029199 * y,
                                 0.4886025119029199 * z,
                                 -0.4886025119029199 * x,
                                 1.0925484305920792 * x * y,
                                 -1.0925484305920792 * y * z,
                                 0.31539156525252005 * (2 * z * z - x * x - y * y),
                                 -1.0925484305920792 * x * z,
                                 0.5462742152960396 * (x * x - y * y),
                                 -0.5900435899266435 * y * (3 * x * x - y * y),
                                 2.890611442640554 * x * y * z,
                                 -0.4570457994644658 * y * (4 * z * z - x * x - y * y),
                                 0.3731763325901154 * z * (2 * z * z - 3 * x * x - 3 * y * y),
                                 -0.4570457994644658 * x * (4 * z * z - x * x - y * y),
                                 1.445305721320277 * z * (x * x - y * y),
                                 -0.5900435899266435 * x * (x * x - 3 * y * y)};
    Harmonics::Values values;
    harmonics.evaluate(Vec3f(d), values);
    for (std::size_t k = 0; k < 16; ++k) EXPECT_NEAR(values[k], expected[k], 1e-6) << k;
  }
}

// A product of midpoints over the height and the azimuth: 1e-4 for products of degree 8.
TEST(harmonics, of_all_degrees_are_orthonormal) {
  const Harmonics harmonics(Harmonics::most);
  constexpr int heights = 800, turns = 40;
  std::vector<double> products(Harmonics::most * Harmonics::most, 0.0);
  for (int i = 0; i < heights; ++i)
    for (int k = 0; k < turns; ++k) {
      const double z = (2 * i + 1.0) / heights - 1, r = std::sqrt(1 - z * z);
      const double angle = 2 * std::numbers::pi * k / turns;
      Harmonics::Values v;
      harmonics.evaluate(Vec3f(Vec3d{r * std::cos(angle), r * std::sin(angle), z}), v);
      for (std::size_t a = 0; a < Harmonics::most; ++a)
        for (std::size_t b = 0; b <= a; ++b) products[a * Harmonics::most + b] += double{v[a]} * double{v[b]};
    }
  for (std::size_t a = 0; a < Harmonics::most; ++a)
    for (std::size_t b = 0; b <= a; ++b)
      EXPECT_NEAR(products[a * Harmonics::most + b] * 4 * std::numbers::pi / (heights * turns), a == b, 1e-3);
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
