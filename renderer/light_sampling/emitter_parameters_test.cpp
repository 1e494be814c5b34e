// Every parameter of every emitter of docs/formats/scene.md, from the scene's text to a pixel, against values by hand.
// The numbers make every axis, channel and angle distinguishable. Each value holds to 1e-4 or to the stated noise. An
// error of 5 %, a mirrored axis or a changed default fails here.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/light_sampling/test_emitters.h"

namespace photonproof::inline renderer_light_sampling {
namespace {

using test::expect_rgb;

constexpr double pi_d = std::numbers::pi, degree = pi_d / 180;
using EmitterParameters = test::EmitterScene;

// --- point -----------------------------------------------------------------------------------------------------------

TEST_F(EmitterParameters, point_defaults_are_one_at_the_origin) {
  expect_rgb(irradiance("<emitter type='point'/>", {0, 0, -2}, {0, 0, 1}), RgbD(0.25));
}

TEST_F(EmitterParameters, point_shines_from_its_position_with_its_intensity) {
  const std::string light =
      "<emitter type='point'><point name='position' value='1, 2, 3'/>"
      "<rgb name='intensity' value='2, 4, 6'/></emitter>";
  expect_rgb(irradiance(light, {1, 2, 0}, {0, 0, 1}), RgbD(2, 4, 6) / 9.0);
  // From (5,2,0): 3 up, 4 aside; d = 5, cos = 3/5. Then 12 behind: (1,-10,-2), d = 13, cos = 5/13.
  expect_rgb(irradiance(light, {5, 2, 0}, {0, 0, 1}), RgbD(2, 4, 6) * (0.6 / 25));
  expect_rgb(irradiance(light, {1, -10, -2}, {0, 0, 1}), RgbD(2, 4, 6) * (5.0 / 13 / 169));
}

TEST_F(EmitterParameters, point_goes_where_to_world_takes_the_origin) {
  // The point (1,2,3) rotated by 90 degrees about y is (3,2,-1).
  const std::string light =
      "<emitter type='point'><transform name='to_world'><scale value='7'/><translate x='1' y='2' "
      "z='3'/><rotate y='1' angle='90'/></transform></emitter>";
  expect_rgb(irradiance(light, {3, 2, -4}, {0, 0, 1}), RgbD(1.0 / 9));
}

// --- spot ------------------------------------------------------------------------------------------------------------

/// Two units from the origin at this angle from +z and this azimuth from +x over +y, in degrees.
Vec3d around_z(double angle, double azimuth) {
  return Vec3d{std::sin(angle * degree) * std::cos(azimuth * degree),
               std::sin(angle * degree) * std::sin(azimuth * degree), std::cos(angle * degree)} *
         2.0;
}

TEST_F(EmitterParameters, spot_defaults_are_a_cone_of_20_degrees_and_a_beam_of_15_along_z) {
  const auto at = [&](double angle) {
    return irradiance("<emitter type='spot'/>", around_z(angle, 30), -around_z(angle, 30)).y * 4;
  };
  EXPECT_NEAR(at(0.01), 1, 1e-4);
  EXPECT_NEAR(at(14.8), 1, 1e-4);
  EXPECT_NEAR(at(16), 0.8, 2e-3);
  EXPECT_NEAR(at(19), 0.2, 2e-3);
  EXPECT_EQ(at(20.2), 0);
  EXPECT_EQ(at(180), 0);
}

TEST_F(EmitterParameters, spot_falls_linearly_from_beam_width_to_cutoff_angle) {
  const auto at = [&](const std::string& angles, double angle) {
    return irradiance("<emitter type='spot'><rgb name='intensity' value='3, 2, 1'/>" + angles + "</emitter>",
                      around_z(angle, 200), -around_z(angle, 200)) *
           4.0;
  };
  const std::string wide = "<float name='cutoff_angle' value='60'/>", narrow = "<float name='beam_width' value='10'/>";
  expect_rgb(at(wide + narrow, 9), RgbD(3, 2, 1));
  expect_rgb(at(wide + narrow, 20), RgbD(3, 2, 1) * 0.8);
  expect_rgb(at(wide + narrow, 35), RgbD(3, 2, 1) * 0.5);
  expect_rgb(at(wide + narrow, 50), RgbD(3, 2, 1) * 0.2, 5e-4);
  EXPECT_EQ(at(wide + narrow, 60.5), RgbD(0.0));
  // Without a beam_width the beam is three quarters of the cut-off: 45 degrees.
  expect_rgb(at(wide, 44), RgbD(3, 2, 1));
  expect_rgb(at(wide, 51), RgbD(3, 2, 1) * 0.6, 5e-4);
}

TEST_F(EmitterParameters, spot_stands_and_points_as_to_world_says) {
  const std::string light =
      "<emitter type='spot'><transform name='to_world'><lookat origin='1, 2, 3' target='1, 5, 3' "
      "up='0, 0, 1'/></transform></emitter>";
  expect_rgb(irradiance(light, {1, 4, 3}, {0, -1, 0}), RgbD(0.25));
  EXPECT_EQ(irradiance(light, {1, 0, 3}, {0, 1, 0}), RgbD(0.0)) << "behind it";
  EXPECT_EQ(irradiance(light, {1, 2, 5}, {0, 0, -1}), RgbD(0.0)) << "beside it";
}

TEST_F(EmitterParameters, spot_projects_its_texture_with_u_along_x_and_v_along_y) {
  // Four texels: u < 1/2 left, v < 1/2 in the first row. The square around the cone of 45 degrees reaches from -1 to 1
  // one unit ahead: local (x, y, 1) sees u = (1 + x) / 2, v = (1 + y) / 2.
  put_four_texels("slide.exr");
  const std::array<RgbD, 4> colours{RgbD(1, 2, 3), RgbD(4, 5, 6), RgbD(7, 8, 9), RgbD(10, 11, 12)};
  const auto light_through = [](const std::string& filter) {
    return "<emitter type='spot'><float name='cutoff_angle' value='45'/><float name='beam_width' value='44'/><rgb "
           "name='intensity' value='2, 1, 1'/><texture type='bitmap' name='texture'><string name='filename' "
           "value='slide.exr'/><boolean name='raw' value='true'/><string name='filter_type' value='" +
           filter + "'/></texture>";
  };
  const auto at = [&](const std::string& to_world, double x, double y, const std::string& filter = "nearest") {
    const Vec3d p{x, y, 1};
    return irradiance(light_through(filter) + to_world + "</emitter>", p, -p) * dot(p, p);
  };
  const RgbD lit(2, 1, 1);
  expect_rgb(at("", -0.3, -0.4), colours[0] * lit);
  expect_rgb(at("", 0.3, -0.4), colours[1] * lit);
  expect_rgb(at("", -0.3, 0.4), colours[2] * lit);
  expect_rgb(at("", 0.3, 0.4), colours[3] * lit);
  expect_rgb(at("", 0.03, -0.02), colours[1] * lit);  // the border between texels is in the middle
  // Bilinear, which shows the scale: x = 1/4 is u = 5/8, three quarters of the way between the middles of the columns;
  // y = -1/2 is the middle of the first row.
  expect_rgb(at("", 0.25, -0.5, "bilinear"), (colours[0] * 0.25 + colours[1] * 0.75) * lit, 1e-3);
  expect_rgb(at("", -0.5, 0.25, "bilinear"), (colours[0] * 0.25 + colours[2] * 0.75) * lit, 1e-3);
  // Rotated about its axis by 90 degrees, world (-y, x) is local (x, y): world (0.4, 0.3) is local (0.3, -0.4).
  expect_rgb(at("<transform name='to_world'><rotate z='1' angle='90'/></transform>", 0.4, 0.3), colours[1] * lit);
}

// --- projector -------------------------------------------------------------------------------------------------------

TEST_F(EmitterParameters, projector_defaults_are_one_through_a_lens_of_50_mm) {
  // pi W m^-2 one unit ahead, a quarter of it two ahead. The film is a square of diagonal hypot(36, 24) mm: half its
  // side is 15.297 mm, which is 0.61187 units on the plane two units ahead.
  const auto at = [&](double x, double y) {
    return irradiance("<emitter type='projector'/>", {x, y, 2}, {0, 0, -1}, 4);
  };
  expect_rgb(at(0, 0), RgbD(pi_d / 4));
  expect_rgb(at(0.6, -0.6), RgbD(pi_d / 4));
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(at(0.624 * side, 0), RgbD(0.0));
    EXPECT_EQ(at(0, 0.624 * side), RgbD(0.0));
  }
  EXPECT_EQ(irradiance("<emitter type='projector'/>", {0, 0, -2}, {0, 0, 1}), RgbD(0.0)) << "behind it";
}

TEST_F(EmitterParameters, projector_lights_planes_across_its_axis_evenly) {
  const std::string light =
      "<emitter type='projector'><float name='fov' value='90'/><float name='scale' value='3'/>"
      "<rgb name='irradiance' value='1, 2, 0.5'/></emitter>";
  const RgbD one_ahead = RgbD(3, 6, 1.5) * pi_d;
  expect_rgb(irradiance(light, {0.1, 0.2, 1}, {0, 0, -1}), one_ahead);
  expect_rgb(irradiance(light, {2.8, -2.7, 3}, {0, 0, -1}), one_ahead / 9.0);
  // A surface that faces the pinhole gets the plane's irradiance over the cosine with the axis, z over the distance.
  expect_rgb(irradiance(light, {2 - 0.1, 1, 2}, {-1.9, -1, -2}), one_ahead / 4.0 * (length(Vec3d(1.9, 1, 2)) / 2));
}

TEST_F(EmitterParameters, projector_stands_and_points_as_to_world_says) {
  const auto light = [](const std::string& first) {
    return "<emitter type='projector'><float name='fov' value='40'/><transform name='to_world'>" + first +
           "<lookat origin='1, 2, 3' target='1, 5, 3' up='0, 0, 1'/></transform></emitter>";
  };
  expect_rgb(irradiance(light(""), {1, 4, 3}, {0, -1, 0}), RgbD(pi_d / 4));
  EXPECT_EQ(irradiance(light(""), {1, 0, 3}, {0, 1, 0}), RgbD(0.0)) << "behind it";
  // A scale s is a factor s, as in Mitsuba's paths: at a distance of z / s, over the cosine with a normal of length s.
  expect_rgb(irradiance(light("<scale value='3'/>"), {1, 4, 3}, {0, -1, 0}), RgbD(3 * pi_d / 4));
}

TEST_F(EmitterParameters, projector_shows_its_image_as_a_camera_would_see_it) {
  // Local (x, y, 1) sees u = (1 - x) / 2, v = (1 - y) / 2 with a field of 90 degrees: the first row is up, +x is left.
  put_four_texels("slide.exr");
  const std::array<RgbD, 4> colours{RgbD(1, 2, 3), RgbD(4, 5, 6), RgbD(7, 8, 9), RgbD(10, 11, 12)};
  const auto at = [&](double x, double y, const std::string& filter, const std::string& to_world = "") {
    return irradiance(
               "<emitter type='projector'><float name='fov' value='90'/><texture type='bitmap' "
               "name='irradiance'><string name='filename' value='slide.exr'/><string name='filter_type' value='" +
                   filter + "'/></texture>" + to_world + "</emitter>",
               {x, y, 1}, {0, 0, -1}) /
           pi_d;
  };
  expect_rgb(at(0.3, 0.4, "nearest"), colours[0]);
  expect_rgb(at(-0.3, 0.4, "nearest"), colours[1]);
  expect_rgb(at(0.3, -0.4, "nearest"), colours[2]);
  expect_rgb(at(-0.3, -0.4, "nearest"), colours[3]);
  // u = 5/8 is three quarters of the way between the middles of the columns, v = 3/4 the middle of the last row.
  expect_rgb(at(-0.25, -0.5, "bilinear"), colours[2] * 0.25 + colours[3] * 0.75, 1e-3);
  // Rotated about its axis by 90 degrees, world (-y, x) is local (x, y): world (0.4, 0.3) is local (0.3, -0.4).
  expect_rgb(at(0.4, 0.3, "nearest", "<transform name='to_world'><rotate z='1' angle='90'/></transform>"), colours[2]);
}

TEST_F(EmitterParameters, projector_has_the_shape_of_its_texels_and_a_field_of_view_along_an_axis) {
  // Three columns, one row. One unit ahead, its half sides for half the tangent 1 along each axis:
  Image wide(3, 1);
  for (float& value : wide.rgb) value = 1;
  put_picture("wide.exr", wide);
  const double diagonal = std::sqrt(10.0);
  for (const auto& [axis, half] : {std::pair<std::string, Vec3d>{"x", {1, 1 / 3.0, 0}},
                                   {"y", {3, 1, 0}},
                                   {"diagonal", {3 / diagonal, 1 / diagonal, 0}},
                                   {"smaller", {3, 1, 0}},
                                   {"larger", {1, 1 / 3.0, 0}}}) {
    const auto lit = [&, name = axis](double x, double y) {
      return irradiance("<emitter type='projector'><float name='fov' value='90'/><string name='fov_axis' value='" +
                            name +
                            "'/><texture type='bitmap' name='irradiance'><string name='filename' "
                            "value='wide.exr'/></texture></emitter>",
                        {x, y, 1}, {0, 0, -1})
                 .x > 0;
    };
    EXPECT_TRUE(lit(0.97 * half.x, 0)) << axis;
    EXPECT_FALSE(lit(1.03 * half.x, 0)) << axis;
    EXPECT_TRUE(lit(0, -0.95 * half.y)) << axis;
    EXPECT_FALSE(lit(0, -1.05 * half.y)) << axis;
  }
}

// --- directional -----------------------------------------------------------------------------------------------------

TEST_F(EmitterParameters, directional_defaults_are_one_along_z) {
  expect_rgb(irradiance("<emitter type='directional'/>", {0, 0, 0}, {0, 0, -1}), RgbD(1.0));
  EXPECT_EQ(irradiance("<emitter type='directional'/>", {0, 0, 0}, {0, 0, 1}), RgbD(0.0));
}

TEST_F(EmitterParameters, directional_travels_along_its_direction_with_its_irradiance) {
  const std::string beam =
      "<emitter type='directional'><vector name='direction' value='2, -6, -3'/>"
      "<rgb name='irradiance' value='7, 14, 21'/></emitter>";  // length 7
  for (const Vec3d p : {Vec3d(0, 0, 0), Vec3d(5, 40, -30)}) {
    expect_rgb(irradiance(beam, p, {0, 1, 0}), RgbD(6, 12, 18));
    expect_rgb(irradiance(beam, p, {-1, 0, 0}), RgbD(2, 4, 6));
    expect_rgb(irradiance(beam, p, {0, 0, 1}), RgbD(3, 6, 9));
    expect_rgb(irradiance(beam, p, {-2, 6, 3}), RgbD(7, 14, 21));
  }
  EXPECT_EQ(irradiance(beam, {}, {1, 0, 0}), RgbD(0.0));
  EXPECT_EQ(irradiance(beam, {}, {0, 0, -1}), RgbD(0.0));
}

TEST_F(EmitterParameters, directional_turns_local_z_by_to_world) {
  // Rotation by 90 degrees about y takes z to x; scale and translation have no effect.
  const std::string beam =
      "<emitter type='directional'><transform name='to_world'><rotate y='1' angle='90'/><scale "
      "value='5'/><translate x='3'/></transform></emitter>";
  expect_rgb(irradiance(beam, {}, {-1, 0, 0}), RgbD(1.0));
  EXPECT_EQ(irradiance(beam, {}, {1, 0, 0}), RgbD(0.0));
}

// --- constant, envmap ------------------------------------------------------------------------------------------------

TEST_F(EmitterParameters, constant_is_its_radiance_everywhere) {
  for (const Vec3d to : {Vec3d(0, 1, 0.1), Vec3d(0, -1, 0.1), Vec3d(1, 0.1, 0)}) {
    expect_rgb(seen("<emitter type='constant'/>", {}, to), RgbD(1.0));
    expect_rgb(seen("<emitter type='constant'><rgb name='radiance' value='1, 0.8, 3'/></emitter>", {}, to),
               RgbD(1, 0.8, 3));
  }
  // E = pi L; a tolerance of 1 % is ten standard errors.
  expect_rgb(irradiance("<emitter type='constant'/>", {}, {0, 1, 0}, 1 << 14), RgbD(pi_d), 0.01);
}

TEST_F(EmitterParameters, envmap_shows_each_column_and_row_in_its_direction) {
  // Mitsuba's convention: u = atan2(x, -z) / (2 pi), texel columns at half-integers of u times width, rows at the
  // multiples of 180 degrees / (height - 1) from +y. For width 8, column 1 is at 1.5 / 8 of a turn, 67.5 degrees. For
  // height 5, row 1 is at 45 degrees.
  Image sky(8, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 8; ++x) {
      sky.pixel(x, y)[0] = static_cast<float>(1 + x);
      sky.pixel(x, y)[1] = static_cast<float>(1 + y);
      sky.pixel(x, y)[2] = x == 1 && y == 1 ? 1.0f : 0.0f;
    }
  put_picture("sky.exr", sky);
  const auto map = [](const std::string& rest) {
    return "<emitter type='envmap'><string name='filename' value='sky.exr'/>" + rest + "</emitter>";
  };
  const auto towards = [](double column, double row) {
    const double phi = (column + 0.5) / 8 * 2 * pi_d, theta = row * 45 * degree;
    return Vec3d{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
  };
  for (int column = 0; column < 8; ++column)
    for (const int row : {1, 2, 3})
      expect_rgb(seen(map(""), {}, towards(column, row)),
                 RgbD(1 + column, 1 + row, column == 1 && row == 1 ? 1.0 : 0.0), 1e-3);
  // Seen directly: column 1.5 at +x, between columns 7 and 0 at -z, 3.5 at +z, 5.5 at -x; the poles.
  expect_rgb(seen(map(""), {}, {1, 0, 0}), RgbD(2.5, 3, 0), 1e-3);
  expect_rgb(seen(map(""), {}, {0, 0, 1}), RgbD(4.5, 3, 0), 1e-3);
  expect_rgb(seen(map(""), {}, {-1, 0, 0}), RgbD(6.5, 3, 0), 1e-3);
  EXPECT_NEAR(seen(map(""), {}, {0, 1, 0}).y, 1, 1e-3);
  EXPECT_NEAR(seen(map(""), {}, {0, -1, 0}).y, 5, 1e-3);
  // Bilinear: a quarter of the way from column 2 to 3, half-way from row 2 to 3.
  expect_rgb(seen(map(""), {}, towards(2.25, 2.5)), RgbD(3.25, 3.5, 0), 1e-3);
  expect_rgb(seen(map("<float name='scale' value='3'/>"), {}, towards(4, 1)), RgbD(15, 6, 0), 1e-3);
  // A quarter turn about x, then about z: local +y goes to z, then stays; local +x stays, then goes to +y.
  const std::string turned =
      map("<transform name='to_world'><rotate x='1' angle='90'/><rotate z='1' angle='90'/>"
          "<scale value='4'/></transform>");
  EXPECT_NEAR(seen(turned, {}, {0, 0, 1}).y, 1, 1e-3);
  expect_rgb(seen(turned, {}, {0, 1, 0}), RgbD(2.5, 3, 0), 1e-3);
}

// --- sunsky ----------------------------------------------------------------------------------------------------------

TEST_F(EmitterParameters, sunsky_is_the_sky_of_its_turbidity_albedo_and_sun) {
  // The radiances are from sky_oracle.py, as in sky_test.cpp. Cases: the zenith for a sun 45 degrees high, with the
  // default turbidity 3 and albedo 0.3; other air and ground. Last, the direction at 50 degrees from a sun in the
  // zenith.
  const auto sky = [](const std::string& rest) { return "<emitter type='sunsky'>" + rest + "</emitter>"; };
  const std::string diagonal = "<vector name='sun_direction' value='1, 0, 1'/>";
  const RgbD zenith(0.02374932, 0.04151599, 0.0840942);
  expect_rgb(seen(sky(diagonal), {}, {0, 0, 1}), zenith, 5e-4);
  expect_rgb(seen(sky(diagonal + "<float name='sky_scale' value='3'/>"), {}, {0, 0, 1}), zenith * 3.0, 5e-4);
  const std::string overhead = "<vector name='sun_direction' value='0, 0, 5'/>";
  expect_rgb(seen(sky(overhead + "<float name='turbidity' value='4'/><rgb name='albedo' value='0.1, 0.4, 0.8'/>"), {},
                  {std::sin(50 * degree), 0, std::cos(50 * degree)}),
             RgbD(0.0444047, 0.08706858, 0.1868301), 5e-4);
  const std::string ahead = "<vector name='sun_direction' value='0, 1, 1'/>";
  // The direction is 45 degrees from the zenith, at 90 degrees of azimuth from the sun.
  expect_rgb(seen(sky(ahead + "<float name='albedo' value='0'/>"), {}, {1, 0, 1}),
             RgbD(0.02464066, 0.04461413, 0.08841319), 5e-4);
  expect_rgb(seen(sky(ahead + "<float name='albedo' value='1'/>"), {}, {1, 0, 1}),
             RgbD(0.04400837, 0.07985137, 0.1508994), 5e-4);
  // World coordinates hold for sun_direction. The zenith is the image of z under to_world: a quarter turn about x, to
  // -y.
  const std::string turned = "<transform name='to_world'><rotate x='1' angle='90'/></transform>";
  expect_rgb(seen(sky("<vector name='sun_direction' value='1, -1, 0'/>" + turned), {}, {0, -1, 0}), zenith, 5e-4);
  EXPECT_EQ(seen(sky("<vector name='sun_direction' value='1, -1, 0'/>" + turned), {}, {0, 1, 0.01}), RgbD(0.0));
}

TEST_F(EmitterParameters, sunsky_has_a_sun_of_its_aperture_and_scale) {
  const auto at = [&](const std::string& rest, double away) {
    return seen(
        "<emitter type='sunsky'><vector name='sun_direction' value='0, 0, 1'/><float name='sky_scale' "
        "value='0'/>" +
            rest + "</emitter>",
        {}, {std::sin(away * degree), 0, std::cos(away * degree)});
  };
  // The real disc has a radius of 0.2679 degrees, 6.8685e-5 sr. By sky_oracle.py the sun in the zenith sends 1.543684,
  // 1.309439 and 1.035036 through turbidity 2.
  const std::string clear = "<float name='turbidity' value='2'/>";
  expect_rgb(at(clear, 0.25), RgbD(22475, 19065, 15070), 5e-5);
  EXPECT_EQ(at(clear, 0.29), RgbD(0.0));
  expect_rgb(at(clear + "<float name='sun_scale' value='2.5'/>", 0), at(clear, 0) * 2.5, 1e-5);
  // A disc ten times as wide is a hundredth as bright: (1 - cos(0.2679)) / (1 - cos(2.679)), 0.010001.
  const std::string wide = clear + "<float name='sun_aperture' value='5.358'/>";
  const double part = (1 - std::cos(0.2679 * degree)) / (1 - std::cos(2.679 * degree));
  expect_rgb(at(wide, 2.6), at(clear, 0) * part, 1e-4);
  EXPECT_EQ(at(wide, 2.75), RgbD(0.0));
}

TEST_F(EmitterParameters, sunsky_puts_the_sun_where_it_is_at_a_place_and_time) {
  // Values from sun_position_oracle.py, azimuths from north over east. As in Mitsuba +x is south and +y west. The pixel
  // sees a sun of 0.5358 degrees in its middle and 0.2 degrees to all sides, so its position holds to 0.07 degrees.
  const auto expect_sun = [&](const std::string& when, double zenith, double azimuth) {
    const std::string sky = "<emitter type='sunsky'><float name='sky_scale' value='0'/>" + when + "</emitter>";
    const auto sun_at = [&](double theta, double phi) { return seen(sky, {}, around_z(theta, phi + 180)).y > 0; };
    const double aside = 1 / std::sin(zenith * degree);
    EXPECT_TRUE(sun_at(zenith, azimuth));
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(sun_at(zenith + sign * 0.2, azimuth)) << sign;
      EXPECT_FALSE(sun_at(zenith + sign * 0.34, azimuth)) << sign;
      EXPECT_TRUE(sun_at(zenith, azimuth + sign * 0.2 * aside)) << sign;
      EXPECT_FALSE(sun_at(zenith, azimuth + sign * 0.34 * aside)) << sign;
    }
  };
  expect_sun("", 43.9152, 265.7486);
  const auto number = [](const char* name, const char* value) {
    return "<float name='" + std::string(name) + "' value='" + value + "'/>";
  };
  const auto whole = [](const char* name, const char* value) {
    return "<integer name='" + std::string(name) + "' value='" + value + "'/>";
  };
  expect_sun(number("latitude", "-33.87") + number("longitude", "151.21") + number("timezone", "10") +
                 whole("year", "2024") + whole("month", "2") + whole("day", "29") + number("hour", "9") +
                 number("minute", "17") + number("second", "40"),
             46.9457, 66.3334);
}

// --- ies -------------------------------------------------------------------------------------------------------------

class IesParameters : public EmitterParameters {
 protected:
  /// Candela at these angles under the light of `file`: from the nadir, -z, and from C0, +x, over C90, +y.
  double candela(const std::string& file, double vertical, double horizontal, const std::string& rest = "") {
    put("light.ies", "IESNA:LM-63-2002\nTILT=NONE\n" + file);
    const Vec3d below = around_z(180 - vertical, horizontal);
    return irradiance("<emitter type='ies'><string name='filename' value='light.ies'/>" + rest + "</emitter>", below,
                      -below)
               .x *
           4;
  }
};

// lights, lumens, multiplier, vertical angles, horizontal angles, type, units, width, length, height; ballast, light,
// watts
const std::string kQuadrant =
    "1 1000 1 3 3 1 2 0.1 0.2 0.3\n1 1 50\n0 30 90\n0 40 90\n"
    "10 20 4\n10 50 8\n10 80 0\n";

TEST_F(IesParameters, candela_of_the_files_angles_from_the_nadir_and_c0) {
  EXPECT_NEAR(candela(kQuadrant, 0.001, 0), 10, 1e-2);
  EXPECT_NEAR(candela(kQuadrant, 30, 0), 20, 1e-2);
  EXPECT_NEAR(candela(kQuadrant, 30, 40), 50, 1e-2);
  EXPECT_NEAR(candela(kQuadrant, 30, 90), 80, 1e-2);
  EXPECT_NEAR(candela(kQuadrant, 89.99, 40), 8, 1e-1);
  EXPECT_EQ(candela(kQuadrant, 95, 0), 0) << "above the file's last angle";
  // Linear between angles: a third from 0 to 30, a half from 0 to 40: ((10 * 2 + 20) / 3 + (10 * 2 + 50) / 3) / 2.
  EXPECT_NEAR(candela(kQuadrant, 10, 20), (40.0 / 3 + 70.0 / 3) / 2, 1e-2);
  // 45 is a quarter from 30 to 90; 70 is 0.6 from 40 to 90: 39.5 * 0.4 + 60 * 0.6.
  EXPECT_NEAR(candela(kQuadrant, 45, 70), 39.5 * 0.4 + 60 * 0.6, 1e-2);
}

TEST_F(IesParameters, last_horizontal_angle_says_how_the_planes_are_mirrored) {
  // Horizontal angles to 90: symmetric about both planes.
  for (const double h : {40.0, 140.0, 220.0, 320.0}) EXPECT_NEAR(candela(kQuadrant, 30, h), 50, 1e-2) << h;
  EXPECT_NEAR(candela(kQuadrant, 30, 180), 20, 1e-2);
  EXPECT_NEAR(candela(kQuadrant, 30, 270), 80, 1e-2);
  // Horizontal angles to 180: symmetric about the plane of C0.
  const std::string half = "1 1000 1 2 3 1 2 0 0 0\n1 1 50\n0 90\n0 60 180\n1 1\n5 5\n9 9\n";
  EXPECT_NEAR(candela(half, 45, 60), 5, 1e-2);
  EXPECT_NEAR(candela(half, 45, 300), 5, 1e-2);
  EXPECT_NEAR(candela(half, 45, 120), 7, 1e-2);
  EXPECT_NEAR(candela(half, 45, 240), 7, 1e-2);
  EXPECT_NEAR(candela(half, 45, 180), 9, 1e-2);
  // Horizontal angles to 360: as in the file.
  const std::string whole = "1 1000 1 2 5 1 2 0 0 0\n1 1 50\n0 180\n0 90 180 270 360\n1 1\n2 2\n4 4\n8 8\n1 1\n";
  EXPECT_NEAR(candela(whole, 100, 90), 2, 1e-2);
  EXPECT_NEAR(candela(whole, 100, 180), 4, 1e-2);
  EXPECT_NEAR(candela(whole, 100, 225), 6, 1e-2);
  EXPECT_NEAR(candela(whole, 100, 270), 8, 1e-2);
  EXPECT_NEAR(candela(whole, 100, 315), 4.5, 1e-2);
  // Horizontal angle 0 only: the same at all azimuths.
  const std::string round = "1 1000 1 3 1 1 2 0 0 0\n1 1 50\n90 135 180\n0\n3 6 7\n";
  for (const double h : {10.0, 100.0, 250.0}) EXPECT_NEAR(candela(round, 135, h), 6, 1e-2);
  EXPECT_NEAR(candela(round, 112.5, 0), 4.5, 1e-2);
  EXPECT_EQ(candela(round, 80, 0), 0) << "the file begins at the horizon";
}

TEST_F(IesParameters, multiplier_ballast_and_light_factors_and_intensity_multiply) {
  // Lumens, lights, sizes, units and watts have no effect.
  const std::string scaled = "4 2500 3 2 1 1 1 9 8 7\n0.5 0.8 99\n0 180\n0\n10 10\n";
  EXPECT_NEAR(candela(scaled, 70, 0), 12, 1e-2);
  EXPECT_NEAR(candela(scaled, 70, 0, "<rgb name='intensity' value='0.25, 1, 1'/>"), 3, 1e-3);
}

TEST_F(IesParameters, light_is_placed_and_turned_by_to_world) {
  // A quarter turn about x takes the nadir from -z to +y and C90 from +y to +z. Then the light moves to (1,2,3). At 30
  // degrees from the nadir, C90 is in the direction (0, cos 30, sin 30) and C0 in (sin 30, cos 30, 0).
  put("light.ies", "TILT=NONE\n" + kQuadrant);
  const std::string light =
      "<emitter type='ies'><string name='filename' value='light.ies'/><transform name='to_world'>"
      "<rotate x='1' angle='90'/><translate x='1' y='2' z='3'/></transform></emitter>";
  const double c = std::cos(30 * degree);
  for (const auto& [way, expected] :
       {std::pair(Vec3d(0, c, 0.5), 80.0), {Vec3d(0.5, c, 0), 20.0}, {Vec3d(0, c, -0.5), 80.0}})
    EXPECT_NEAR(irradiance(light, Vec3d(1, 2, 3) + way * 2.0, -way).y * 4, expected, 0.01);
  EXPECT_EQ(irradiance(light, {1, 0, 3}, {0, 1, 0}), RgbD(0.0)) << "above it";
}

}  // namespace
}  // namespace photonproof::inline renderer_light_sampling
