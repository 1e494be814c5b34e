// POV-Ray's radiosity without its cache, compared with theory and with itself under other random numbers.
#include "reference/povray/povray_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/povray/povray_engine.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_povray {
namespace {

/// A point light of intensity 1 in the middle of a ball of radius 1, seen from within: with an albedo rho the radiance
/// is rho / (pi (1 - rho)) everywhere. `more` is what else is in the scene.
SceneDescription ball(double albedo, const std::string& more = "") {
  const std::string text = R"(<scene version="3.0.0"><integrator type="path"/>
    <sensor type="perspective"><float name="fov" value="60"/>
      <transform name="to_world"><lookat origin="0, 0, -0.5" target="0, 0, 1" up="0, 1, 0"/></transform>
      <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/>
        <rfilter type="box"/></film></sensor>
    <shape type="sphere"><boolean name="flip_normals" value="true"/>
      <bsdf type="diffuse"><rgb name="reflectance" value=")" +
                           std::to_string(albedo) + R"("/></bsdf></shape>
    <emitter type="point"><point name="position" value="0, 0.3, 0"/><rgb name="intensity" value="1"/></emitter>)" +
                           more + "</scene>";
  return parse_scene_text(text, "ball.xml");
}

/// A floor and a wall in the open, lit by a spot that points at the floor. Most of the wall's light comes from the
/// floor, and most of its rays meet nothing.
const std::string kCorner = R"(<scene version="3.0.0"><integrator type="path"/>
    <sensor type="perspective"><float name="fov" value="40"/>
      <transform name="to_world"><lookat origin="0, 1, 3" target="0, 1, 0" up="0, 1, 0"/></transform>
      <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/>
        <rfilter type="box"/></film></sensor>
    <bsdf type="diffuse" id="grey"><rgb name="reflectance" value="0.7"/></bsdf>
    <shape type="rectangle"><transform name="to_world"><scale x="2" y="1.2"/><translate y="1.2"/></transform>
      <ref id="grey"/></shape>
    <shape type="rectangle"><transform name="to_world"><scale value="2"/><rotate x="1" angle="-90"/></transform>
      <ref id="grey"/></shape>
    <emitter type="spot"><float name="cutoff_angle" value="30"/><rgb name="intensity" value="20"/>
      <transform name="to_world"><lookat origin="0, 2.5, 1" target="0, 0, 1" up="1, 0, 0"/></transform></emitter>
  </scene>)";

/// A wall that ends 0.55 across the middle of three pixels, evenly lit from far, and one out of sight, without which
/// there are no paths.
const std::string kEdge = R"(<scene version="3.0.0"><integrator type="path"/>
    <sensor type="perspective"><float name="fov" value="73.739795"/>
      <transform name="to_world"><lookat origin="0, 0, 2" target="0, 0, 0" up="0, 1, 0"/></transform>
      <film type="hdrfilm"><rfilter type="box"/></film></sensor>
    <shape type="rectangle"><transform name="to_world"><scale value="5"/><translate x="-4.95"/></transform></shape>
    <shape type="rectangle"><transform name="to_world"><rotate y="1" angle="180"/><translate x="30" z="5"/></transform>
      <bsdf type="diffuse"><rgb name="reflectance" value="0.001"/></bsdf></shape>
    <emitter type="point"><point name="position" value="0, 0, 1000"/><rgb name="intensity" value="1e6"/></emitter>
  </scene>)";

struct MeanOf {
  double value = 0, standard_error = 0;
};

MeanOf green_mean(const Rendering& picture) {
  MeanOf mean;
  const double pixels = static_cast<double>(picture.mean.pixels());
  for (std::size_t i = 1; i < picture.mean.rgb.size(); i += 3) {
    mean.value += double{picture.mean.rgb[i]} / pixels;
    mean.standard_error += double{picture.variance->rgb[i]} / (pixels * pixels);
  }
  mean.standard_error = std::sqrt(mean.standard_error);
  return mean;
}

Rendering by_paths(const SceneDescription& scene, int size = 32, std::uint64_t seed = 1) {
  return render_povray(export_povray(scene, {.width = size, .height = size, .quality = 4, .seed = seed})).rendering;
}

/// Direct and bounced radiance at the visible points. The direct part is E rho / pi, averaged over the image by a sum
/// over its pixels. The bounced part is rho / (1 - rho) of the flux spread evenly.
double integrating_ball(double albedo) {
  const double half = std::tan(std::numbers::pi / 6);
  double direct = 0;
  constexpr int side = 320;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double u = (2 * (x + 0.5) / side - 1) * half, v = (2 * (y + 0.5) / side - 1) * half;
      const double length = std::sqrt(u * u + v * v + 1);
      const Vec3d d{u / length, v / length, 1 / length}, eye{0, 0, -0.5}, light{0, 0.3, 0};
      const double b = dot(eye, d), t = -b + std::sqrt(b * b - dot(eye, eye) + 1);
      const Vec3d p = eye + d * t, to = light - p;
      const double distance = std::sqrt(dot(to, to));
      direct += -dot(to, p) / (distance * distance * distance) / (side * side);
    }
  return albedo / std::numbers::pi * (direct + albedo / (1 - albedo));
}

// Quality 4 claims no bias. A ball of albedo 0.5 loses 2^-21 to the end of its bounces; the rest is noise, and the test
// detects an error of 0.5 %. Paths that ended in a quarter of every surface without a brighter rest would give -20 %.
TEST(povray_paths, find_the_light_of_an_integrating_sphere) {
  const MeanOf mean = green_mean(by_paths(ball(0.5)));
  EXPECT_NEAR(mean.value, integrating_ball(0.5), 4 * mean.standard_error + 2e-4 * mean.value);
  EXPECT_LT(mean.standard_error, 1.2e-3 * mean.value) << "what the tolerance is";
}

// All visible light came around two corners. Its mean is from the bidirectional path tracer, which shares no code with
// POV-Ray: `photonproof render scenes/library/corridor/scene.xml --integrator bdpt --size 32x32 --spp 8192`, to 0.3 %.
// POV-Ray's cache makes it 140 % more. Bounces with directions in step would be detected, too: -37 %.
TEST(povray_paths, find_light_that_comes_around_corners) {
  const MeanOf mean =
      green_mean(by_paths(parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/corridor/scene.xml"), 24));
  EXPECT_NEAR(mean.value, 0.01292, 4 * mean.standard_error + 0.005 * 0.01292);
  EXPECT_LT(mean.standard_error, 0.04 * 0.01292);
}

// Without the ball around everything, POV-Ray keeps samples whose rays all miss and reuses them from then on. A wall
// whose rays mostly miss was black from some pixel on.
TEST(povray_paths, of_an_open_scene_find_its_light_in_every_part_of_the_picture) {
  const Rendering picture = by_paths(parse_scene_text(kCorner, "corner.xml"));
  const Rendering cached =
      render_povray(export_povray(parse_scene_text(kCorner, "corner.xml"), {.grid = 4, .quality = 2})).rendering;
  for (int part = 0; part < 4; ++part) {
    double sum = 0, variance = 0, expected = 0;
    for (int y = 8 * part; y < 8 * (part + 1); ++y)
      for (int x = 0; x < 32; ++x) {
        sum += double{picture.mean.pixel(x, y)[1]};
        variance += double{picture.variance->pixel(x, y)[1]};
        expected += double{cached.mean.pixel(x, y)[1]};
      }
    EXPECT_NEAR(sum, expected, 4 * std::sqrt(variance) + 0.01 * expected) << part;
  }
}

// The variance predicts their spread from seed to seed. Edges in the image would count in the variance; this image has
// none.
TEST(povray_paths, say_how_far_their_mean_is_off) {
  constexpr int count = 8;
  double sum = 0, squares = 0, claimed = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const MeanOf mean = green_mean(by_paths(ball(0.5), 12, static_cast<std::uint64_t>(seed)));
    sum += mean.value;
    squares += mean.value * mean.value;
    claimed += mean.standard_error * mean.standard_error / count;
  }
  const double measured = (squares - sum * sum / count) / (count - 1);
  // chi^2 of 7 degrees: more than 3.5 times the claim once in a thousand.
  EXPECT_LT(measured, 3.5 * claimed);
  EXPECT_GT(measured, 0.05 * claimed) << "seeds that change nothing";
}

// The grid's centres are uniform in their sub-pixels. Over 1,000 seeds their mean is 0 within 4 standard errors, and
// their variance is 1/12 within 4 standard errors, which are 10 %. The shifts across and down are independent.
TEST(povray_paths, move_their_grid_evenly_within_a_sub_pixel) {
  constexpr int count = 1000, across = 80, down = 60;
  PovCamera camera;
  camera.middle_x = 0.25;
  double x = 0, xx = 0, y = 0, yy = 0, xy = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const PovCamera moved = with_moved_grid(camera, across, down, seed);
    const double dx = (moved.middle_x - 0.25) * across / 2, dy = moved.middle_y * down / 2;  // sub-pixels
    ASSERT_LE(std::max(std::abs(dx), std::abs(dy)), 0.5);
    x += dx / count, xx += dx * dx / count, y += dy / count, yy += dy * dy / count, xy += dx * dy / count;
  }
  const double deviation = std::sqrt(1.0 / 12 / count);
  EXPECT_NEAR(x, 0, 4 * deviation);
  EXPECT_NEAR(y, 0, 4 * deviation);
  EXPECT_NEAR(xx, 1.0 / 12, 0.1 / 12);
  EXPECT_NEAR(yy, 1.0 / 12, 0.1 / 12);
  EXPECT_NEAR(xy, 0, 4.0 / 12 * deviation * std::sqrt(12.0));
  camera.kind = PovCamera::Kind::fisheye;
  EXPECT_EQ(with_moved_grid(camera, across, down, 1).middle_x, 0.25);
}

// 0.55 is between the third and the fourth of five lines: a fixed grid makes it 0.6 for every seed.
TEST(povray_paths, show_an_edge_by_the_lines_of_their_grid_that_meet_the_wall) {
  double least = 1, most = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const double shift = with_moved_grid({}, 15, 15, seed).middle_x * 15 / 2;  // sub-pixels to the right
    double expected = 0;
    for (int line = 0; line < 5; ++line) expected += line + 0.5 + shift < 0.55 * 5 ? 0.2 : 0;
    const Image picture = by_paths(parse_scene_text(kEdge, "edge.xml"), 3, seed).mean;
    EXPECT_NEAR(picture.pixel(1, 1)[1] / picture.pixel(0, 1)[1], expected, 0.002) << "seed " << seed;
    least = std::min(least, expected), most = std::max(most, expected);
  }
  EXPECT_LT(least, most) << "seeds that see the same";
}

TEST(povray_paths, are_of_quality_4_and_of_scenes_with_lights_alone) {
  const auto text = [](const SceneDescription& scene, int quality) {
    return export_povray(scene, {.quality = quality}).sdl.str();
  };
  EXPECT_NE(text(ball(0.5), 4).find("importance 0.2"), std::string::npos);
  EXPECT_EQ(text(ball(0.5), 3).find("importance"), std::string::npos);
  SceneDescription dark = ball(0.5);
  dark.emitters.clear();
  EXPECT_EQ(text(dark, 4).find("importance"), std::string::npos) << "there is no light";
}

// 1, 2, 3, 6: mean 3, squares of what they differ by 4 + 1 + 0 + 9 = 14, over 4 x 3.
TEST(povray_paths, variance_of_blocks_is_that_of_their_mean) {
  Image image(2, 2);
  const float values[] = {1, 2, 3, 6};
  for (int i = 0; i < 4; ++i) image.pixel(i % 2, i / 2)[1] = values[i];
  const Image variance = variance_of_blocks(image, 2, 0.5);
  EXPECT_FLOAT_EQ(variance.pixel(0, 0)[1], 0.25F * 14 / 12);
  EXPECT_EQ(variance.pixel(0, 0)[0], 0);
}

}  // namespace
}  // namespace photonproof::inline reference_povray
