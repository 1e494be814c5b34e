// The library's chart scenes against harness/oracles/charts.py, a ray caster in another language that shares no code
// with the renderer. They check cameras, filters, clip planes, transforms, uv and bitmaps in a non-square image. Two
// charts include the film's border; chart-lens does not, a difference of .6 % of its mean. A mirrored image, another
// axis of the field of view or half a texel changes the moments by per cents. An error of 5 % in a filter's width, an
// aperture or a focus distance changes some pixel by ten times the tolerance.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "renderer/integrators/test_scenes.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_integrators {
namespace {

constexpr int width = 24, height = 16;

struct Shown {
  int x, y;
  RgbD value;
};

struct Chart {
  const char* scene;
  RgbD mean, along_x, along_y;  ///< moments over the image's unit square
  std::array<Shown, 6> pixels;
};
void PrintTo(const Chart& chart, std::ostream* out) { *out << chart.scene; }

class ChartScene : public testing::TestWithParam<Chart> {};

struct Moments {
  RgbD mean{0.0}, along_x{0.0}, along_y{0.0};
};

Moments moments_of(const Image& image) {
  Moments m;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float* p = image.pixel(x, y);
      const RgbD value = RgbD{p[0], p[1], p[2]} / double{width * height};
      m.mean = m.mean + value;
      m.along_x = m.along_x + value * ((x + 0.5) / width);
      m.along_y = m.along_y + value * ((y + 0.5) / height);
    }
  return m;
}

void expect_near(const RgbD& got, const RgbD& expected, double tolerance, const std::string& what) {
  EXPECT_NEAR(got.x, expected.x, tolerance) << what << ", red";
  EXPECT_NEAR(got.y, expected.y, tolerance) << what << ", green";
  EXPECT_NEAR(got.z, expected.z, tolerance) << what << ", blue";
}

// The script's own error is about 2e-4 in the moments and 1e-3 in the shown pixels, which it samples more finely.
constexpr double of_moments = 6e-4, of_pixels = 3e-3;

TEST_P(ChartScene, is_what_another_ray_caster_shows) {
  const Chart& chart = GetParam();
  SceneDescription scene =
      parse_scene_file(std::string(PHOTONPROOF_SOURCE_DIR) + "/scenes/library/" + chart.scene + "/scene.xml");
  scene.sensor.film.width = width;
  scene.sensor.film.height = height;
  for (const char* integrator : {"path", "volpath"}) {
    const Image image = test::render(scene, integrator, test::job_with(4096, 0, 1)).image.mean;
    const Moments got = moments_of(image);
    const std::string what = std::string(chart.scene) + " by " + integrator;
    expect_near(got.mean, chart.mean, of_moments, what + ", mean");
    expect_near(got.along_x, chart.along_x, of_moments, what + ", along x");
    expect_near(got.along_y, chart.along_y, of_moments, what + ", along y");
    for (const Shown& shown : chart.pixels) {
      const float* p = image.pixel(shown.x, shown.y);
      expect_near({p[0], p[1], p[2]}, shown.value, of_pixels,
                  what + ", pixel " + std::to_string(shown.x) + ", " + std::to_string(shown.y));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(library, ChartScene,
                         testing::Values(Chart{"chart",
                                               RgbD{0.24352, 0.23824, 0.27755},
                                               RgbD{0.11483, 0.13945, 0.13704},
                                               RgbD{0.12248, 0.11173, 0.11443},
                                               {{{5, 3, RgbD{0.36869, 0.21606, 0.66195}},
                                                 {11, 7, RgbD{0.24027, 0.29921, 0.34784}},
                                                 {12, 8, RgbD{0.37350, 0.36005, 0.24533}},
                                                 {17, 4, RgbD{0.22983, 0.84051, 0.64199}},
                                                 {8, 12, RgbD{0.38901, 0.11890, 0.03938}},
                                                 {18, 11, RgbD{0.32899, 0.37366, 0.21916}}}}},
                                         Chart{"chart-lens",
                                               RgbD{0.34351, 0.35484, 0.29831},
                                               RgbD{0.18652, 0.19023, 0.14008},
                                               RgbD{0.18309, 0.18134, 0.10149},
                                               {{{5, 3, RgbD{0.35133, 0.52552, 0.58001}},
                                                 {11, 7, RgbD{0.36094, 0.20071, 0.28393}},
                                                 {12, 8, RgbD{0.36748, 0.27826, 0.21115}},
                                                 {17, 4, RgbD{0.09495, 0.15704, 0.18049}},
                                                 {8, 12, RgbD{0.30872, 0.07232, 0.06234}},
                                                 {18, 11, RgbD{0.29027, 0.29561, 0.27935}}}}},
                                         Chart{"chart-fisheye",
                                               RgbD{0.17209, 0.14053, 0.18420},
                                               RgbD{0.08608, 0.06710, 0.09877},
                                               RgbD{0.08641, 0.06657, 0.09715},
                                               {{{5, 3, RgbD{0.20106, 0.52889, 0.18452}},
                                                 {11, 7, RgbD{0.30458, 0.09910, 0.43219}},
                                                 {12, 8, RgbD{0.15231, 0.19364, 0.59027}},
                                                 {17, 4, RgbD{0.30006, 0.70174, 0.17906}},
                                                 {8, 12, RgbD{0.51925, 0.23695, 0.13190}},
                                                 {18, 11, RgbD{0.38303, 0.04411, 0.19466}}}}},
                                         Chart{"chart-orthographic",
                                               RgbD{0.16771, 0.21072, 0.18846},
                                               RgbD{0.08144, 0.10418, 0.09831},
                                               RgbD{0.08395, 0.10060, 0.09776},
                                               {{{5, 3, RgbD{0.29692, 0.35495, 0.03195}},
                                                 {11, 7, RgbD{0.10004, 0.12014, 0.15002}},
                                                 {12, 8, RgbD{0.10022, 0.11982, 0.15065}},
                                                 {17, 4, RgbD{0.32191, 0.22895, 0.07803}},
                                                 {8, 12, RgbD{0.31741, 0.34770, 0.50360}},
                                                 {18, 11, RgbD{0.31955, 0.43984, 0.19622}}}}}),
                         [](const auto& test) {
                           std::string name = test.param.scene;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace photonproof::inline renderer_integrators
