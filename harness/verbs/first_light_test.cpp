// The claims of README's table, made by the program itself on the library's scenes: every test renders through the
// command line and prints the figure it checks.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "harness/metrics/metrics.h"
#include "reference/closed_forms/closed_forms.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs {
namespace {

const std::string library = PHOTONPROOF_SOURCE_DIR "/scenes/library/";

class FirstLight : public FolderTest {
 protected:
  /// Runs the program; its exit code must be 0.
  void run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> argv{PHOTONPROOF_BINARY};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    const ProcessOutcome outcome = run_process(argv);
    ASSERT_TRUE(outcome.ok()) << outcome.sentence() << "\n" << outcome.standard_error;
  }

  /// One of our engines on a library scene of size x size pixels.
  Image render(const std::string& scene, const std::string& integrator, int size, int spp,
               std::vector<std::string> more = {}) const {
    const std::string out = (folder_ / (scene + "_" + integrator + ".exr")).string();
    std::vector<std::string> arguments{
        "render", library + scene + "/scene.xml", "-o", out, "--integrator", integrator, "--spp", std::to_string(spp),
        "--size"};
    arguments.push_back(std::to_string(size) + "x" + std::to_string(size));
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(arguments);
    return read_image(out);
  }

  Image povray(const std::string& scene, int size, int quality, int grid) const {
    const std::string out = (folder_ / (scene + "_povray.exr")).string();
    const std::string pixels = std::to_string(size) + "x" + std::to_string(size);
    run({"povray", library + scene + "/scene.xml", "-o", out, "--size", pixels, "--quality", std::to_string(quality),
         "--grid", std::to_string(grid)});
    return read_image(out);
  }
};

double mean(const Image& image) {
  double sum = 0;
  for (const float v : image.rgb) sum += double{v};
  return sum / static_cast<double>(image.rgb.size());
}

/// Largest |value / expected - 1| over all pixels and channels.
double worst(const Image& image, const std::function<double(int, int)>& expected) {
  double largest = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        largest = std::max(largest, std::abs(double{image.pixel(x, y)[c]} / expected(x, y) - 1));
  return largest;
}

/// Radiance of a plane of albedo 0.5 at y = 0 under `irradiance`, as a pixel's mean over the 8x8 grid that the engines
/// sample. Random samples would show slopes as noise, since the far rows dim by a quarter a pixel. The camera is that
/// of light-point and light-area: at (0, 1.5, 3), looking at the origin, 30 degrees across.
double plane_radiance(int x, int y, int size, const std::function<double(const Vec3d&)>& irradiance) {
  const Vec3d eye{0, 1.5, 3};
  const Vec3d forward = normalize(-eye);
  const Vec3d right{1, 0, 0};
  const Vec3d up = cross(right, forward);
  const double half = std::tan(15 * std::numbers::pi / 180);
  constexpr int lattice = 8;
  double sum = 0;
  for (int i = 0; i < lattice * lattice; ++i) {
    const double across = (x + (i % lattice + 0.5) / lattice) / size * 2 - 1;
    const double down = (y + (i / lattice + 0.5) / lattice) / size * 2 - 1;
    const Vec3d d = forward + right * (across * half) - up * (down * half);
    sum += irradiance(eye + d * (-eye.y / d.y));
  }
  return 0.5 / std::numbers::pi * sum / (lattice * lattice);
}

double light_point_irradiance(const Vec3d& p) { return irradiance_of_point(20, {0, 2.5, 0}, {p, {0, 1, 0}}); }

double light_area_irradiance(const Vec3d& p) {
  // Shines downwards: its corners run counter-clockwise seen from below.
  const std::array<Vec3d, 4> corners{Vec3d{-0.25, 2.5, -0.25}, Vec3d{0.25, 2.5, -0.25}, Vec3d{0.25, 2.5, 0.25},
                                     Vec3d{-0.25, 2.5, 0.25}};
  return irradiance_of_polygon(80, corners, {p, {0, 1, 0}});
}

TEST_F(FirstLight, furnace_by_path_is_two_at_every_pixel) {
  const double error = worst(render("furnace", "path", 64, 64), [](int, int) { return furnace(1, 0.5); });
  std::printf("furnace, path: worst pixel %.4f %% from 2\n", 100 * error);
  EXPECT_LT(error, 0.005);
}

TEST_F(FirstLight, furnace_by_photon_mapper_is_two_in_the_mean_and_in_every_block) {
  const Image image = render("furnace", "photonmapper", 64, 16, {"--photons", "1000000"});
  double worst_block = 0;
  for (int y = 0; y < 64; y += 8) {
    for (int x = 0; x < 64; x += 8) {
      double sum = 0;
      for (int i = 0; i < 64; ++i)
        for (int c = 0; c < 3; ++c) sum += double{image.pixel(x + i % 8, y + i / 8)[c]};
      worst_block = std::max(worst_block, std::abs(sum / (64 * 3) / 2 - 1));
    }
  }
  std::printf("furnace, photon mapper: mean %.4f %%, worst 8x8 block %.4f %% from 2\n", 100 * (mean(image) / 2 - 1),
              100 * worst_block);
  EXPECT_NEAR(mean(image), 2, 0.005 * 2);
  EXPECT_LT(worst_block, 0.02);
}

TEST_F(FirstLight, light_point_by_path_is_the_closed_form_at_every_pixel) {
  const double error = worst(render("light-point", "path", 32, 64, {"--grid", "8"}),
                             [](int x, int y) { return plane_radiance(x, y, 32, light_point_irradiance); });
  std::printf("light-point, path: worst pixel %.4f %% from the closed form\n", 100 * error);
  EXPECT_LT(error, 0.002);
}

TEST_F(FirstLight, light_area_by_path_is_the_closed_form_at_every_pixel) {
  // A sample's deviation is 12 % at worst (d^-4 over the far light), 0.035 % after 2^17 of them: the bound is 5.7
  // sigma.
  const double error = worst(render("light-area", "path", 16, 131072, {"--grid", "8"}),
                             [](int x, int y) { return plane_radiance(x, y, 16, light_area_irradiance); });
  std::printf("light-area, path: worst pixel %.4f %% from the closed form\n", 100 * error);
  EXPECT_LT(error, 0.002);
}

TEST_F(FirstLight, light_point_by_povray_is_the_closed_form_at_every_pixel) {
  const double error = worst(povray("light-point", 32, 3, 8),
                             [](int x, int y) { return plane_radiance(x, y, 32, light_point_irradiance); });
  std::printf("light-point, POV-Ray: worst pixel %.4f %% from the closed form\n", 100 * error);
  EXPECT_LT(error, 0.002);
}

TEST_F(FirstLight, light_area_by_povray_is_the_closed_form_at_every_pixel) {
  const double error = worst(povray("light-area", 32, 3, 8),
                             [](int x, int y) { return plane_radiance(x, y, 32, light_area_irradiance); });
  std::printf("light-area, POV-Ray: worst pixel %.4f %% from the closed form\n", 100 * error);
  EXPECT_LT(error, 0.002);
}

TEST_F(FirstLight, cornell_by_three_engines_has_one_mean_and_one_picture) {
  // The grid that POV-Ray samples, for all: silhouettes sampled differently would count as differences.
  const Image path = render("cornell", "path", 64, 1024, {"--grid", "4"});
  const Image photons = render("cornell", "photonmapper", 64, 64, {"--grid", "4"});
  const Image pov = povray("cornell", 64, 1, 4);
  double ssim = 0;
  for (const MetricValue& metric : compute_metrics(path, pov, {}))
    if (metric.name == "ssim") ssim = metric.value;
  std::printf(
      "cornell: mean of the photon mapper %+.3f %%, of POV-Ray %+.3f %% from path; ssim of path and POV-Ray %.4f\n",
      100 * (mean(photons) / mean(path) - 1), 100 * (mean(pov) / mean(path) - 1), ssim);
  EXPECT_NEAR(mean(photons) / mean(path), 1, 0.015);
  EXPECT_NEAR(mean(pov) / mean(path), 1, 0.015);
  EXPECT_NEAR(mean(pov) / mean(photons), 1, 0.015);
  EXPECT_GE(ssim, 0.97);
}

TEST_F(FirstLight, threads_do_not_change_a_bit_of_either_engine) {
  for (const char* integrator : {"path", "photonmapper"}) {
    const Image one = render("cornell-spheres", integrator, 48, 8, {"--threads", "1", "--seed", "5"});
    for (const char* threads : {"2", "7"})
      EXPECT_EQ(one.rgb, render("cornell-spheres", integrator, 48, 8, {"--threads", threads, "--seed", "5"}).rgb);
  }
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
