#include "harness/verify/probes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scenes/files/scratch_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_verify {
namespace {

const Probe& probe_of(const std::string& what) { return *std::ranges::find(probe_rows(), what, &Probe::what); }

/// The probe's closed form times gain plus offset, with noise of this standard deviation.
EnginePicture picture_of(const Probe& probe, double gain, double offset, double deviation = 0) {
  constexpr int side = 32;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  EnginePicture picture;
  picture.rendering.mean = Image(side, side);
  picture.rendering.variance = Image(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const RgbD light = probe.radiance(2 * (x + 0.5) / side - 1, 1 - 2 * (y + 0.5) / side);
      const double values[] = {light.x, light.y, light.z};
      for (std::size_t c = 0; c < 3; ++c) {
        picture.rendering.mean.pixel(x, y)[c] =
            static_cast<float>(gain * values[c] + offset + deviation * normal(random));
        picture.rendering.variance->pixel(x, y)[c] = static_cast<float>(deviation * deviation);
      }
    }
  return picture;
}

TEST(Probes, gain_and_offset_are_told_apart) {
  const Probe& probe = probe_of("point light");
  const ProbeFit brighter = fit_probe(probe, picture_of(probe, 1.02, 0));
  ASSERT_TRUE(brighter.has_offset);
  EXPECT_NEAR(brighter.gain, 1.02, 1e-3);
  EXPECT_NEAR(brighter.offset, 0, 1e-3);
  const ProbeFit raised = fit_probe(probe, picture_of(probe, 1, 0.05));
  EXPECT_NEAR(raised.gain, 1, 1e-3);
  EXPECT_GT(raised.offset, 0.02);
}

TEST(Probes, of_even_light_have_a_gain_alone) {
  const Probe& probe = probe_of("directional light");
  const ProbeFit fit = fit_probe(probe, picture_of(probe, 0.5, 0));
  EXPECT_FALSE(fit.has_offset);
  EXPECT_NEAR(fit.gain, 0.5, 1e-6);
}

// The colours of Phong's floor vary, its places hardly. With much noise a gain beside an offset is arbitrary.
TEST(Probes, of_much_noise_have_a_gain_alone) {
  const Probe& probe = probe_of("phong");
  ASSERT_TRUE(fit_probe(probe, picture_of(probe, 1.1, 0)).has_offset);
  const ProbeFit fit = fit_probe(probe, picture_of(probe, 1.1, 0, 1));
  EXPECT_FALSE(fit.has_offset);
  EXPECT_NEAR(fit.gain, 1.1, 4 * fit.gain_error);
  EXPECT_LT(fit.gain_error, 0.1);
}

// The mean of 3072 values of about 0.4 is known to 0.02 / sqrt(3072) / 0.4 = 0.09 %; the gain beside an offset is less
// certain.
TEST(Probes, errors_of_a_fit_are_those_of_noise) {
  const Probe& probe = probe_of("point light");
  const ProbeFit fit = fit_probe(probe, picture_of(probe, 1, 0, 0.02));
  EXPECT_GT(fit.gain_error, 0.0009);
  EXPECT_LT(fit.gain_error, 0.01);
  EXPECT_LT(std::abs(fit.gain - 1), 4 * fit.gain_error);
}

TEST(Probes, are_those_of_what_a_scene_holds) {
  const SceneDescription scene = parse_scene_text(R"(<scene version="3.0.0"><sensor type="perspective"/>
    <emitter type="spot"/><shape type="sphere"><bsdf type="conductor"/></shape></scene>)",
                                                  "scene.xml");
  EXPECT_EQ(kinds_in(scene), (std::vector<std::string>{"mirror", "perspective camera", "spot light"}));
}

TEST(Probes, have_names_and_scenes_of_their_own) {
  const ScratchFolder folder("probes");
  for (const Probe& probe : probe_rows()) {
    EXPECT_EQ(std::ranges::count(probe_rows(), probe.what, &Probe::what), 1);
    const SceneDescription scene = write_probe(probe, folder.path() / "probe.xml");
    EXPECT_GT(probe.radiance(0.1, 0.1).x, 0) << probe.what;
    // The scene of glass also contains a lossless ball.
    EXPECT_TRUE(probe.what == "lossless glass" || std::ranges::count(kinds_in(scene), probe.what) == 1) << probe.what;
  }
}

}  // namespace
}  // namespace photonproof::inline harness_verify
