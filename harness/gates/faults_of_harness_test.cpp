// The effects of the harness's faults (scenes/base/faults.h) on the images that gates get, and on their verdicts.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "harness/gates/gate_images.h"
#include "harness/gates/test_gates.h"
#include "harness/statistics/deviations.h"
#include "scenes/base/faults.h"

namespace photonproof::inline harness_gates {
namespace {

class FaultsOfHarness : public FakeGateTest {
 protected:
  void SetUp() override {
    FakeGateTest::SetUp();
    std::string suite = gates_text(gate("good", "agreement", 0.05)), logging = gate_script;
    // Adds seed and amount of each image to the log.
    for (std::string::size_type at = 0; (at = suite.find("'{scene}']", at)) != std::string::npos; at += 20)
      suite.replace(at, 10, "'{scene}', '{amount}']");
    logging.replace(logging.find("$1 $4"), 5, "$4 $6");
    put("gates.toml", suite);
    put("gate.sh", logging);
    put_reference();
  }

  /// Draws four images as gates get them.
  std::vector<Image> draw() const {
    std::filesystem::remove(folder_ / "log");
    const GateSuite suite = read_gate_suite(folder_ / "gates.toml");
    DrawOptions options;
    options.folder = folder_ / "out";
    std::filesystem::create_directories(options.folder);
    ImageStream stream(suite, suite.gates.front(), {"hash", "version"}, {}, options);
    EXPECT_TRUE(stream.draw(4));
    std::vector<Image> images;
    for (const auto& drawn : stream.drawn()) images.push_back(drawn->image);
    return images;
  }
  std::vector<std::string> log() const {
    std::istringstream text(get("log"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

  static Deviations deviations(const std::vector<Image>& images) {
    Rendering exact{Image(width, height), Image(width, height), {}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) exact.mean.pixel(x, y)[c] = static_cast<float>(expected(x, y, c));
    std::vector<const Image*> pointers;
    for (const Image& image : images) pointers.push_back(&image);
    return measure_deviations(exact, pointers, {});
  }
};

TEST_F(FaultsOfHarness, are_planted_while_asked_for_and_named) {
  EXPECT_EQ(planted_fault(), "");
  {
    const PlantedFault planted("upside-down");
    EXPECT_TRUE(has_fault(Fault::upside_down));
    EXPECT_FALSE(has_fault(Fault::repeated_seed));
    EXPECT_EQ(planted_fault(), "upside-down");
  }
  EXPECT_FALSE(has_fault(Fault::upside_down));
  EXPECT_THROW(PlantedFault("upside-dow"), std::invalid_argument);
}

TEST_F(FaultsOfHarness, repeated_seed_draws_one_image_again_and_again) {
  draw();
  EXPECT_EQ(log(), (std::vector<std::string>{"1000000 64", "1000001 64", "1000002 64", "1000003 64"}));
  const PlantedFault planted("repeated-seed");
  draw();
  EXPECT_EQ(log(), std::vector<std::string>(4, "1 64"));
}

TEST_F(FaultsOfHarness, quarter_budget_reaches_the_engine) {
  const PlantedFault planted("quarter-budget");
  draw();
  EXPECT_EQ(log(), (std::vector<std::string>{"1000000 16", "1000001 16", "1000002 16", "1000003 16"}));
}

TEST_F(FaultsOfHarness, upside_down_reverses_the_rows) {
  const std::vector<Image> right = draw();
  const PlantedFault planted("upside-down");
  const std::vector<Image> turned = draw();
  for (std::size_t i = 0; i < 4; ++i)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(turned[i].pixel(x, y)[c], right[i].pixel(x, height - 1 - y)[c]) << i << " " << x << " " << y;
}

// Green is 0.1 brighter than red everywhere, and blue 0.2.
TEST_F(FaultsOfHarness, red_for_all_finds_green_and_blue_as_dark_as_red) {
  const std::vector<Image> images = draw();
  const Deviations right = deviations(images);
  const PlantedFault planted("red-for-all");
  const Deviations wrong = deviations(images);
  for (std::size_t c = 0; c < 3; ++c) {
    // Noise of 2 % in 768 pixels of four images leaves 0.0003.
    EXPECT_NEAR(right.whole[c].difference, 0, 0.003) << c;
    EXPECT_NEAR(wrong.whole[c].difference, -0.1 * static_cast<double>(c), 0.003) << c;
  }
}

TEST_F(FaultsOfHarness, certain_noise_makes_blocks_surer_by_the_root_of_the_number_of_images) {
  const std::vector<Image> images = draw();
  const Deviations right = deviations(images);
  const PlantedFault planted("certain-noise");
  const Deviations wrong = deviations(images);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t b = 0; b < right.places.size(); ++b)  // the reference's part of the error is a hundredth
      EXPECT_NEAR(right.blocks[c][b].standard_error / wrong.blocks[c][b].standard_error, 2, 0.02) << c << " " << b;
}

}  // namespace
}  // namespace photonproof::inline harness_gates
