// The area emitter's parameters on every shape, tested as in emitter_parameters_test.cpp.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/light_sampling/test_emitters.h"

namespace photonproof::inline renderer_light_sampling {
namespace {

using test::expect_rgb;

constexpr double pi_d = std::numbers::pi;
using AreaEmitter = test::EmitterScene;

std::string glowing(const std::string& type, const std::string& rest, const std::string& radiance) {
  return "<shape type='" + type + "'>" + rest +
         "<bsdf type='diffuse'><float name='reflectance' value='0'/></bsdf><emitter type='area'>" + radiance +
         "</emitter></shape>";
}

TEST_F(AreaEmitter, shines_its_radiance_from_the_side_of_the_normal) {
  const std::string colour = "<rgb name='radiance' value='2, 3, 5'/>",
                    flip = "<boolean name='flip_normals' value='true'/>";
  for (const char* type : {"rectangle", "disk"}) {
    expect_rgb(seen(glowing(type, "", colour), {0.3, 0.2, 2}, {0.1, 0.1, 0}), RgbD(2, 3, 5));
    EXPECT_EQ(seen(glowing(type, "", colour), {0.3, 0.2, -2}, {0.1, 0.1, 0}), RgbD(0.0)) << type;
    EXPECT_EQ(seen(glowing(type, flip, colour), {0.3, 0.2, 2}, {0.1, 0.1, 0}), RgbD(0.0)) << type;
    expect_rgb(seen(glowing(type, flip, ""), {0.3, 0.2, -2}, {0.1, 0.1, 0}), RgbD(1.0));
  }
  for (const char* type : {"sphere", "cube", "cylinder"}) {
    expect_rgb(seen(glowing(type, "", colour), {3, 0.2, 0.5}, {0, 0.1, 0.5}), RgbD(2, 3, 5));
    EXPECT_EQ(seen(glowing(type, "", colour), {0, 0.2, 0.5}, {3, 0.1, 0.5}), RgbD(0.0)) << type << " from inside";
    expect_rgb(seen(glowing(type, flip, colour), {0, 0.2, 0.5}, {3, 0.1, 0.5}), RgbD(2, 3, 5));
  }
}

TEST_F(AreaEmitter, lights_what_their_normal_points_to) {
  // Sampled light, not directly visible light. A tolerance of 1 % is at least ten standard errors.
  const std::string flip = "<boolean name='flip_normals' value='true'/>";
  for (const char* type : {"rectangle", "disk"}) {
    const double before = irradiance(glowing(type, "", ""), {0, 0, 2}, {0, 0, -1}, 1 << 12).x;
    // The square of half-side 1, two units away: the form below with x = y = 1/2. The disk: pi r^2 / (r^2 + h^2).
    const double root = std::sqrt(1.25), square = 4 * (0.5 / root * std::atan(0.5 / root));
    const double expected = type == std::string("disk") ? pi_d / 5 : square;
    EXPECT_NEAR(before, expected, 0.01 * expected) << type;
    EXPECT_EQ(irradiance(glowing(type, "", ""), {0, 0, -2}, {0, 0, 1}, 64), RgbD(0.0)) << type;
    EXPECT_EQ(irradiance(glowing(type, flip, ""), {0, 0, 2}, {0, 0, -1}, 64), RgbD(0.0)) << type;
    EXPECT_NEAR(irradiance(glowing(type, flip, ""), {0, 0, -2}, {0, 0, 1}, 1 << 12).x, expected, 0.01 * expected)
        << type;
  }
  // Inside a closed shape that shines inward: pi. In front of a sphere: pi (r/d)^2.
  for (const char* type : {"sphere", "cube"}) {
    EXPECT_NEAR(irradiance(glowing(type, flip, ""), {0.2, -0.1, 0.3}, {1, 2, 3}, 1 << 12).x, pi_d, 0.01 * pi_d) << type;
    EXPECT_EQ(irradiance(glowing(type, flip, ""), {0, 0, 2}, {0, 0, -1}, 64), RgbD(0.0)) << type;
    EXPECT_EQ(irradiance(glowing(type, "", ""), {0.2, -0.1, 0.3}, {1, 2, 3}, 64), RgbD(0.0)) << type;
  }
  EXPECT_NEAR(irradiance(glowing("sphere", "", ""), {0, 0, 2}, {0, 0, -1}, 1 << 12).x, pi_d / 4, 0.01 * pi_d / 4);
  const std::string tube = "<float name='radius' value='0.5'/>";
  EXPECT_EQ(irradiance(glowing("cylinder", tube, ""), {0, 0, 0.5}, {1, 0, 0}, 64), RgbD(0.0));
  EXPECT_EQ(irradiance(glowing("cylinder", tube + flip, ""), {2, 0, 0.5}, {-1, 0, 0}, 64), RgbD(0.0));
  EXPECT_GT(irradiance(glowing("cylinder", tube, ""), {2, 0, 0.5}, {-1, 0, 0}, 64).x, 0.25);
}

TEST_F(AreaEmitter, of_a_scaled_shape_has_its_area) {
  // The point is h = 4 above. For a rectangle of half-sides a = 2 and b = 1/2, set x = a/h and y = b/h in the closed
  // form.
  //   `E = L 2 (x / sqrt(1 + x^2) atan(y / sqrt(1 + x^2)) + y / sqrt(1 + y^2) atan(x / sqrt(1 + y^2)))`.
  // For a disk of radius 3/2, E = pi L r^2 / (r^2 + h^2).
  const auto above = [](const std::string& scale) {
    return "<transform name='to_world'><scale " + scale + "/><rotate x='1' angle='90'/><translate y='4'/></transform>";
  };
  const double x = 0.5, y = 0.125, a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  const double rectangle = 2 * (x / a * std::atan(y / a) + y / b * std::atan(x / b));
  const double disk = pi_d * 2.25 / (2.25 + 16);
  const std::string stretched = glowing("rectangle", above("x='2' y='0.5'"), "");
  // A tolerance of 1 % is at least ten standard errors.
  EXPECT_NEAR(irradiance(stretched, {}, {0, 1, 0}, 1 << 12).x, rectangle, 0.01 * rectangle);
  EXPECT_NEAR(irradiance(glowing("disk", above("value='1.5'"), ""), {}, {0, 1, 0}, 1 << 12).x, disk, 0.01 * disk);
}

TEST_F(AreaEmitter, of_a_shape_without_a_bsdf_stands_on_black) {
  // A light of irradiance pi adds its reflectance to the emission of a facing surface. The sum is 2 + 0 here, and would
  // be 2.5 if the shape kept the default BSDF of shapes without an emitter. Mitsuba 3 and 0.6 have 2.
  const std::string sun =
      "<emitter type='directional'><vector name='direction' value='0, 0, -1'/><float name='irradiance' "
      "value='3.14159265'/></emitter>";
  const std::string glow = "<emitter type='area'><float name='radiance' value='2'/></emitter>";
  put("square.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n");
  for (const std::string shape :
       {"'rectangle'>", "'disk'>", "'sphere'>", "'ply'><string name='filename' value='square.ply'/>",
        "'heightfield'><float name='amplitude' value='0'/><integer name='columns' value='1'/><integer name='rows' "
        "value='1'/>"}) {
    SCOPED_TRACE(shape);
    const auto pixel = [&](const std::string& rest) {
      return seen(sun + "<shape type=" + shape + rest + "</shape>", {0.001, 0.002, 4}, {0.001, 0.002, 0});
    };
    expect_rgb(pixel(glow), RgbD(2));
    expect_rgb(pixel(""), RgbD(0.5));
    expect_rgb(pixel(glow + "<bsdf type='diffuse'/>"), RgbD(2.5));
  }
}

TEST_F(AreaEmitter, wears_its_texture) {
  // On the rectangle u grows along its local x, v along y: the first texel is at (-, -).
  put_four_texels("light.exr");
  const std::string light =
      glowing("rectangle", "",
              "<texture type='bitmap' name='radiance'><string name='filename' value='light.exr'/><boolean "
              "name='raw' value='true'/><string name='filter_type' value='nearest'/></texture>");
  expect_rgb(seen(light, {-0.4, -0.3, 2}, {-0.4, -0.3, 0}), RgbD(1, 2, 3));
  expect_rgb(seen(light, {0.4, -0.3, 2}, {0.4, -0.3, 0}), RgbD(4, 5, 6));
  expect_rgb(seen(light, {-0.4, 0.3, 2}, {-0.4, 0.3, 0}), RgbD(7, 8, 9));
  expect_rgb(seen(light, {0.4, 0.3, 2}, {0.4, 0.3, 0}), RgbD(10, 11, 12));
  // The illumination one unit above (1/2, -1/4): E is the sum over the texels' squares of colour times a form factor.
  // The form factor is that of a rectangle between two lines x and two lines y. A tolerance of 1 % is at least five
  // standard errors.
  const auto corner = [](double x, double y) {  // signed, between the foot of the point and (x, y)
    const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
    return 0.5 * (x / a * std::atan(y / a) + y / b * std::atan(x / b));
  };
  RgbD expected(0.0);
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column) {
      const double x0 = column - 1.5, x1 = column - 0.5, y0 = row - 0.75, y1 = row + 0.25;
      const double form = corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
      const double first = 3 * (2 * row + column) + 1;
      expected += RgbD(first, first + 1, first + 2) * form;
    }
  expect_rgb(irradiance(light, {0.5, -0.25, 1}, {0, 0, -1}, 1 << 13), expected, 0.01);
}

}  // namespace
}  // namespace photonproof::inline renderer_light_sampling
