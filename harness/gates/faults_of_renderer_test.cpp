// The effects of the renderer's faults (scenes/base/faults.h) on an image. The expected image is a closed form, or that
// of a sound program with the mistake in its scene.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "harness/gates/test_faulty_program.h"

namespace photonproof::inline harness_gates {
namespace {

using std::numbers::pi;

/// The integral by Simpson's rule.
double integral(double from, double to, const std::function<double(double)>& f) {
  constexpr int steps = 2000;
  const double width = (to - from) / steps;
  double sum = f(from) + f(to);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(from + i * width);
  return sum * width / 3;
}

class FaultsOfRenderer : public FaultyProgramTest {
 protected:
  /// Every value must be within `relative` times the largest expected value of its expected one.
  static void expect_near(const Image& image, const Image& expected, double relative, const std::string& what) {
    ASSERT_EQ(image.rgb.size(), expected.rgb.size()) << what;
    ASSERT_FALSE(expected.rgb.empty()) << what;
    const double scale = double{*std::max_element(expected.rgb.begin(), expected.rgb.end())};
    EXPECT_GT(scale, 0) << what;
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
      ASSERT_NEAR(image.rgb[i], expected.rgb[i], relative * scale) << what << " at value " << i;
  }
  /// The image must differ from a sound one, which proves that the scene shows the fault.
  static void expect_other(const Image& sound_image, const Image& faulty_image, double least, const std::string& what) {
    ASSERT_EQ(sound_image.rgb.size(), faulty_image.rgb.size()) << what;
    double difference = 0;
    for (std::size_t i = 0; i < sound_image.rgb.size(); ++i)
      difference += std::abs(double{sound_image.rgb[i]} - double{faulty_image.rgb[i]});
    EXPECT_GT(difference, least * sum(sound_image)) << what;
  }
  /// The fault on `scene` must give, bit for bit, the sound program's image of `mistaken`, and not that of `scene`.
  void expect_same_as(const std::string& fault, const std::string& scene, const std::string& mistaken,
                      const std::vector<std::string>& options) const {
    const Image image = render(faulty, fault, scene, options);
    EXPECT_TRUE(image.rgb == render(sound, "", mistaken, options).rgb) << fault;
    expect_other(render(sound, "", scene, options), image, 0.001, fault);
  }

  /// A wall whose light comes from a light by a mirror, so that all photons on it are caustic ones.
  std::string put_wall_by_mirror() const {
    return put_scene("mirror.xml",
                     R"(photonmapper"><integer name="max_depth" value="3"/><float name="global_radius" value="0.3"/>
                     <float name="caustic_radius" value="0.3"/><integer name="caustic_photons" value="20000"/>
                     <integer name="global_photons" value="1000"/>)",
                     wall(grey(0.5)) + R"(<shape type="rectangle">
                     <transform name="to_world"><scale value="4"/><rotate x="1" angle="180"/><translate z="5"/></transform>
                     <bsdf type="conductor"><string name="material" value="none"/></bsdf></shape>
                     <shape type="rectangle">
                     <transform name="to_world"><scale value="0.5"/><translate y="2" z="2"/></transform>)" +
                         grey(0) + R"(<emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>)");
  }
};

// Cosine mu: light of a surrounding sphere has the sampling density p = 1/4pi, the surface's weight assumes mu/pi. The
// power heuristic gives lights the share w = 1/(1 + 16 mu^2). For sky 1 and albedo r the wall shows
//   r integral from 0 to 1 of [2 mu w + (1 - w)] = r (ln(17)/16 + 1 - atan(4)/4).
TEST_F(FaultsOfRenderer, uniform_diffuse_takes_light_evenly) {
  const std::string scene =
      put_scene("scene.xml", R"(path"><integer name="max_depth" value="2"/>)", wall(grey(0.5)) + sky(1));
  const std::vector<std::string> options{"--spp", "256"};
  // 65536 samples, each with a spread below 0.3, have a deviation of 0.0012.
  EXPECT_NEAR(mean(render(sound, "", scene, options)), 0.5, 0.004);
  EXPECT_NEAR(mean(render(faulty, "uniform-diffuse", scene, options)),
              0.5 * (std::log(17.0) / 16 + 1 - std::atan(4.0) / 4), 0.004);
}

// The test has only the photon mapper's direct light. Sampling nine tenths of the light's width with the density of the
// whole light equals a light of nine tenths whose radiance is ten ninths.
TEST_F(FaultsOfRenderer, part_of_light_is_a_smaller_and_brighter_light) {
  const auto put_light = [&](const std::string& name, const std::string& part, double radiance) {
    return put_scene(name, R"(photonmapper"><integer name="max_depth" value="2"/>)",
                     wall(grey(0.5)) + R"(<shape type="rectangle"><transform name="to_world">)" + part +
                         R"(<scale value="0.25"/><rotate y="1" angle="180"/><translate y="2.5" z="3"/></transform>)" +
                         grey(0) + R"(<emitter type="area"><rgb name="radiance" value=")" + std::to_string(radiance) +
                         R"("/></emitter></shape>)");
  };
  const std::string light = put_light("lamp.xml", "", 9);
  const std::string part = put_light("part.xml", R"(<scale x="0.9"/><translate x="-0.1"/>)", 10);
  const std::vector<std::string> options{"--spp", "4", "--photons", "1000"};
  const Image image = render(faulty, "part-of-lamp", light, options);
  expect_near(image, render(sound, "", part, options), 1e-4, "part-of-lamp");
  expect_other(render(sound, "", light, options), image, 0.001, "part-of-lamp");
}

// A ball straight above a point fills a cone whose sine is 1/2. Samples over the cone's solid angle have the density p
// = 1/(2 pi (1 - cos)). Paths that hit it, of density mu/pi, should have the weight w = 1/(1 + (p pi/mu)^2). With both
// in full, the point shows r integral over 2 mu of (1 - w) + 1.
TEST_F(FaultsOfRenderer, unweighted_hits_count_lights_twice) {
  const std::string scene = put_scene(
      "scene.xml", R"(path"><integer name="max_depth" value="2"/><boolean name="hide_emitters" value="false"/>)",
      wall(grey(0.5)) + R"(<shape type="sphere"><point name="center" value="0,0,12"/>
                <float name="radius" value="6"/>)" +
          grey(0) + R"(<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)",
      0.1);
  const std::vector<std::string> options{"--spp", "256"};
  const double least_cosine = std::sqrt(0.75), p = 1 / (2 * pi * (1 - least_cosine));
  const double expected = integral(least_cosine, 1, [&](double mu) {
    const double weight_of_hits = 1 / (1 + std::pow(p * pi / mu, 2));
    return 0.5 * 2 * mu * (2 - weight_of_hits);
  });
  // The albedo is 0.5, the projected share of the sky 1/4. A quarter of the samples hit: the deviation is 0.22 / 256.
  EXPECT_NEAR(mean(render(sound, "", scene, options)), 0.125, 0.003);
  EXPECT_NEAR(mean(render(faulty, "unweighted-hits", scene, options)), expected, 0.003);
}

TEST_F(FaultsOfRenderer, unpaid_roulette_loses_what_it_ends) {
  // A mirror of 1/2 under a sky of 1: half of the paths continue, with a weight of a half each.
  const std::string scene = put_scene("scene.xml", R"(path"><integer name="rr_depth" value="1"/>)",
                                      wall(R"(<bsdf type="conductor"><string name="material" value="none"/>
           <rgb name="specular_reflectance" value="0.5"/></bsdf>)") +
                                          sky(1));
  const std::vector<std::string> options{"--spp", "256"};
  // 65536 samples of 0 or 1 have a deviation of 0.002.
  EXPECT_NEAR(mean(render(sound, "", scene, options)), 0.5, 0.006);
  EXPECT_NEAR(mean(render(faulty, "unpaid-roulette", scene, options)), 0.25, 0.006);
}

TEST_F(FaultsOfRenderer, dim_caustic_and_density_radius_scale_what_photons_bring) {
  const std::string scene = put_wall_by_mirror();
  const std::vector<std::string> options{"--spp", "4"};
  const Image right = render(sound, "", scene, options);
  ASSERT_GT(sum(right), 0);
  for (const auto& [fault, factor] : {std::pair{"dim-caustic", 0.95}, {"density-radius", 1 / 1.21}}) {
    Image expected = right;
    for (float& value : expected.rgb) value = static_cast<float>(value * factor);
    // The tolerance covers some float operations, and the disc's area in floats.
    expect_near(render(faulty, fault, scene, options), expected, 1e-5, fault);
  }
}

TEST_F(FaultsOfRenderer, same_photons_land_where_those_of_seed_1_do) {
  const std::string scene = put_wall_by_mirror();
  // One sample in each pixel's middle: only the photons are random.
  const std::vector<std::string> options{"--spp", "1", "--grid", "1"};
  const Image of_seed_5 = render(faulty, "same-photons", scene, options), right = render(sound, "", scene, options);
  expect_other(right, of_seed_5, 0.001, "same-photons");
  seed_ = "1";
  EXPECT_TRUE(render(sound, "", scene, options).rgb == of_seed_5.rgb);
}

TEST_F(FaultsOfRenderer, same_samples_are_those_of_seed_1) {
  const std::string scene = put_scene("scene.xml", R"(path">)", wall(grey(0.5)) + sky(1));
  const std::vector<std::string> options{"--spp", "4"};
  const Image of_seed_5 = render(faulty, "same-samples", scene, options), right = render(sound, "", scene, options);
  expect_other(right, of_seed_5, 0.001, "same-samples");
  seed_ = "1";
  EXPECT_TRUE(render(sound, "", scene, options).rgb == of_seed_5.rgb);
}

TEST_F(FaultsOfRenderer, wide_filter_is_one_of_larger_deviation) {
  const auto put_board = [&](const std::string& name, const char* deviation) {
    return put_scene(
        name, R"(path">)",
        wall(diffuse(R"(<texture name="reflectance" type="checkerboard">
                     <rgb name="color0" value="0.1"/><rgb name="color1" value="0.9"/>
                     <transform name="to_uv"><scale value="20"/></transform></texture>)")) +
            R"(<emitter type="directional"><vector name="direction" value="0,0,-1"/>
                         <rgb name="irradiance" value="1"/></emitter>)",
        30, std::string(R"(<rfilter type="gaussian"><float name="stddev" value=")") + deviation + R"("/></rfilter>)");
  };
  const std::string narrow = put_board("narrow.xml", "0.5"), wide = put_board("wide.xml", "0.6");
  const std::vector<std::string> options{"--spp", "16"};
  const Image image = render(faulty, "wide-filter", narrow, options), expected = render(sound, "", wide, options);
  expect_other(render(sound, "", narrow, options), image, 0.01, "wide-filter");
  // The samples are the same up to rounding, which may move one beside an edge of the board to its other side.
  double difference = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) difference += std::abs(image.rgb[i] - expected.rgb[i]);
  EXPECT_LT(difference, 1e-4 * sum(expected));
}

TEST_F(FaultsOfRenderer, flipped_v_is_a_bitmap_with_its_rows_reversed) {
  const auto put_texture = [&](const std::string& name, bool reversed) {
    Rendering bitmap;
    bitmap.mean = Image(3, 4);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 3; ++x)
        for (int c = 0; c < 3; ++c)
          bitmap.mean.pixel(x, reversed ? 3 - y : y)[c] = static_cast<float>(0.1 + 0.2 * y + 0.05 * x + 0.01 * c);
    write_exr(path(name + ".exr"), bitmap);
    return put_scene(
        name + ".xml", R"(path">)",
        wall(diffuse(R"(<texture name="reflectance" type="bitmap">
                     <string name="filter_type" value="nearest"/><string name="filename" value=")" +
                     name + R"(.exr"/><transform name="to_uv"><scale value="3"/></transform></texture>)")) +
            sky(1));
  };
  expect_same_as("flipped-v", put_texture("bitmap", false), put_texture("reversed", true), {"--spp", "4"});
}

TEST_F(FaultsOfRenderer, raw_srgb_is_a_bitmap_said_to_be_raw) {
  std::filesystem::copy_file(library + "maps/chart.png", folder_ / "chart.png");
  const auto put_wall = [&](const std::string& name, const std::string& raw) {
    return put_scene(name, R"(path">)",
                     wall(diffuse(R"(<texture name="reflectance" type="bitmap">
                     <string name="filename" value="chart.png"/><boolean name="raw" value=")" +
                                  raw + R"("/></texture>)")) +
                         sky(1));
  };
  expect_same_as("raw-srgb", put_wall("scene.xml", "false"), put_wall("raw.xml", "true"), {"--spp", "4"});
}

std::string cube_of_medium(const std::string& medium) {
  return R"(<shape type="cube"><bsdf type="null"/><medium type="homogeneous" name="interior">)" + medium +
         "</medium></shape>";
}

TEST_F(FaultsOfRenderer, thin_medium_lets_through_what_nine_tenths_of_it_would) {
  kernels_ = {};
  // Two units of extinction 0.5, seen straight on against a sky of 1.
  const std::string scene =
      put_scene("scene.xml", R"(volpath">)",
                cube_of_medium(R"(<float name="sigma_t" value="0.5"/><rgb name="albedo" value="0"/>)") + sky(1), 0.1);
  for (const float value : render(sound, "", scene, {"--spp", "1"}).rgb) EXPECT_NEAR(value, std::exp(-1.0), 1e-5);
  for (const float value : render(faulty, "thin-medium", scene, {"--spp", "1"}).rgb)
    EXPECT_NEAR(value, std::exp(-0.9), 1e-5);
}

TEST_F(FaultsOfRenderer, backward_phase_scatters_by_minus_g) {
  kernels_ = {};
  const auto put_fog = [&](const std::string& name, const std::string& g) {
    return put_scene(name, R"(volpath">)",
                     cube_of_medium(R"(<float name="sigma_t" value="0.5"/><rgb name="albedo" value="0.8"/>
                     <phase type="hg"><float name="g" value=")" +
                                    g + R"("/></phase>)") +
                         R"(<emitter type="point"><point name="position" value="2,0,3"/>
                         <rgb name="intensity" value="5"/></emitter>)");
  };
  expect_same_as("backward-phase", put_fog("scene.xml", "0.6"), put_fog("backward.xml", "-0.6"), {"--spp", "8"});
}

TEST_F(FaultsOfRenderer, fov_axis_takes_the_angle_across_the_height) {
  size_ = "24x16";
  const auto put_view = [&](const std::string& name, const std::string& axis) {
    return put_scene(name, R"(path">)",
                     R"(<shape type="sphere"><float name="radius" value="0.5"/>)" + grey(0.5) + "</shape>" + sky(1), 30,
                     R"(<rfilter type="box"/>)", R"(<string name="fov_axis" value=")" + axis + "\"/>");
  };
  expect_same_as("fov-axis", put_view("scene.xml", "x"), put_view("y.xml", "y"), {"--spp", "4"});
}

TEST_F(FaultsOfRenderer, spot_angle_makes_spots_half_as_wide) {
  const auto put_spot = [&](const std::string& name, const std::string& cutoff, const std::string& beam) {
    return put_scene(name, R"(path">)",
                     wall(grey(0.5)) + R"(<emitter type="spot"><rgb name="intensity" value="10"/>
                     <float name="cutoff_angle" value=")" +
                         cutoff + R"("/><float name="beam_width" value=")" + beam +
                         R"("/><transform name="to_world"><lookat origin="0,1,4" target="0,0,0" up="0,1,0"/>
                         </transform></emitter>)");
  };
  expect_same_as("spot-angle", put_spot("scene.xml", "20", "12"), put_spot("half.xml", "10", "6"), {"--spp", "4"});
}

TEST_F(FaultsOfRenderer, turned_sky_turns_the_other_way) {
  Rendering image;
  image.mean = Image(8, 5);
  for (std::size_t i = 0; i < image.mean.rgb.size(); ++i) image.mean.rgb[i] = static_cast<float>((7 * i) % 11);
  write_exr(path("sky.exr"), image);
  const auto put_sky = [&](const std::string& name, const std::string& angle) {
    return put_scene(name, R"(path">)",
                     R"(<emitter type="envmap"><string name="filename" value="sky.exr"/><transform name="to_world">
                     <rotate y="1" angle=")" +
                         angle + R"("/></transform></emitter>)",
                     80);
  };
  const std::string scene = put_sky("scene.xml", "70"), other = put_sky("other.xml", "-70");
  const std::vector<std::string> options{"--spp", "4"};
  const Image turned = render(faulty, "turned-sky", scene, options);
  expect_near(turned, render(sound, "", other, options), 1e-5, "turned-sky");
  expect_other(render(sound, "", scene, options), turned, 0.1, "turned-sky");
}

TEST_F(FaultsOfRenderer, swapped_ior_is_a_bubble) {
  const auto put_ball = [&](const std::string& name, const std::string& inside, const std::string& outside) {
    return put_scene(name, R"(path">)",
                     wall(diffuse(R"(<texture name="reflectance" type="checkerboard"/>)")) +
                         R"(<shape type="sphere"><point name="center" value="0,0,1"/><float name="radius" value="0.7"/>
                         <bsdf type="dielectric"><float name="int_ior" value=")" +
                         inside + R"("/><float name="ext_ior" value=")" + outside + R"("/></bsdf></shape>)" + sky(1));
  };
  expect_same_as("swapped-ior", put_ball("scene.xml", "1.5", "1"), put_ball("bubble.xml", "1", "1.5"), {"--spp", "4"});
}

TEST_F(FaultsOfRenderer, single_reflection_leaves_out_those_between) {
  // A pane of index 1.5 before a wall of radiance 1: one surface reflects R = 0.04, the pane 2R/(1+R).
  const std::string scene =
      put_scene("scene.xml", R"(path">)",
                R"(<shape type="rectangle"><transform name="to_world"><scale value="4"/></transform>)" + grey(0) +
                    R"(<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>
                <shape type="rectangle"><transform name="to_world"><translate z="1"/></transform>
                <bsdf type="thindielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>
                </shape>)",
                0.1);
  const std::vector<std::string> options{"--spp", "256"};
  // 65536 samples of 0 or 1 have a deviation of 0.001.
  EXPECT_NEAR(mean(render(sound, "", scene, options)), 1 - 0.08 / 1.04, 0.004);
  EXPECT_NEAR(mean(render(faulty, "single-reflection", scene, options)), 0.96, 0.004);
}

TEST_F(FaultsOfRenderer, flat_normals_are_those_of_faces) {
  put("roof.obj",
      "v -2 -2 0\nv 0 -2 0.5\nv 0 2 0.5\nv -2 2 0\nv 2 -2 0\nv 2 2 0\n"
      "vn -0.2 0 1\nvn 0 0.1 1\nvn 0 -0.1 1\nvn -0.4 0 1\nvn 0.3 0 1\nvn 0.5 0 1\n"
      "f 1//1 2//2 3//3\nf 1//1 3//3 4//4\nf 2//2 5//5 6//6\nf 2//2 6//6 3//3\n");
  const auto put_roof = [&](const std::string& name, const std::string& flat) {
    return put_scene(
        name, R"(path"><integer name="max_depth" value="2"/>)",
        R"(<shape type="obj"><string name="filename" value="roof.obj"/><boolean name="face_normals" value=")" + flat +
            "\"/>" + grey(0.5) + R"(</shape>
                     <emitter type="directional"><vector name="direction" value="-1,-1,-2"/>
                     <rgb name="irradiance" value="1"/></emitter>)");
  };
  const std::string smooth = put_roof("scene.xml", "false"), flat = put_roof("flat.xml", "true");
  const std::vector<std::string> options{"--spp", "4"};
  const Image image = render(faulty, "flat-normals", smooth, options);
  expect_near(image, render(sound, "", flat, options), 1e-5, "flat-normals");
  expect_other(render(sound, "", smooth, options), image, 0.01, "flat-normals");
}

}  // namespace
}  // namespace photonproof::inline harness_gates
