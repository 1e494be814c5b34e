#include "harness/verify/reference_witness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scenes/parser/parser.h"

namespace photonproof::inline harness_verify {
namespace {

std::string witness_of(const std::string& name, const std::string& parent, const std::string& refused = "") {
  const std::string path = PHOTONPROOF_SOURCE_DIR "/scenes/library/" + name + "/scene.xml";
  return witness_for(parse_scene_file(path), parent, read_expect(expect_path_of(path)),
                     [&](const std::string& estimator) { return std::string(estimator == refused ? "cannot" : ""); });
}

TEST(ReferenceWitness, shares_no_sampling_with_the_parent) {
  EXPECT_EQ(witness_of("cornell", "path"), "bdpt");
  EXPECT_EQ(witness_of("cornell", "path", "bdpt"), "volpath");
  EXPECT_EQ(witness_of("cornell-spheres", "bdpt"), "volpath");
  EXPECT_EQ(witness_of("cornell", "photonmapper"), "bdpt");  // its camera paths are path's
}

TEST(ReferenceWitness, is_none_where_no_other_way_finds_the_light) {
  EXPECT_EQ(witness_of("fog", "volpath"), "");            // a medium that scatters is volpath's alone
  EXPECT_EQ(witness_of("ball-lens", "bdpt"), "ptracer");  // path finds no point light through glass; ball unseen
}

/// A level of 0.5 with noise of this standard deviation.
Rendering noisy_grey(std::uint64_t seed, double gain, double deviation = 0.01) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Rendering rendering{Image(32, 32), Image(32, 32), {}};
  for (std::size_t i = 0; i < rendering.mean.rgb.size(); ++i) {
    rendering.mean.rgb[i] = static_cast<float>(0.5 * gain + deviation * normal(random));
    rendering.variance->rgb[i] = static_cast<float>(deviation * deviation);
  }
  return rendering;
}

TEST(ReferenceWitness, that_is_off_by_a_percent_disagrees_and_says_what_it_sees) {
  const PairTest same = test_witness(noisy_grey(1, 1), 0, noisy_grey(2, 1.001));
  EXPECT_FALSE(same.differs);
  EXPECT_LT(same.would_see.value(), 0.01);
  EXPECT_TRUE(test_witness(noisy_grey(1, 1), 0, noisy_grey(2, 1.01)).differs);
  EXPECT_FALSE(test_witness(noisy_grey(1, 1), 0.01, noisy_grey(2, 1.01)).differs);  // within the stated bias
}

}  // namespace
}  // namespace photonproof::inline harness_verify
