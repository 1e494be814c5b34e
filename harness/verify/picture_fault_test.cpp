#include "harness/verify/picture_fault.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "harness/verify/engine_renderer.h"

namespace photonproof::inline harness_verify {
namespace {

constexpr int kSide = 32;

/// Rectangles of several brightnesses, whose edges at (`x`, y) may lie within pixels, with noise of 1 %.
EnginePicture rectangles(std::uint64_t seed, double shift = 0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  EnginePicture picture;
  picture.rendering.mean = Image(kSide, kSide);
  picture.rendering.variance = Image(kSide, kSide);
  const auto light = [](double x, double y) { return x < 11 ? 0.3 : y < 20 ? 0.9 : x < 25 ? 0.5 : 0.1; };
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        double mean = 0;
        for (int i = 0; i < 8; ++i) mean += light(x + (i + 0.5) / 8 - shift, y) * (0.6 + 0.2 * double(c)) / 8;
        picture.rendering.mean.pixel(x, y)[c] = static_cast<float>(mean * (1 + 0.01 * normal(random)));
        picture.rendering.variance->pixel(x, y)[c] = static_cast<float>(std::pow(0.01 * mean, 2));
      }
  return picture;
}

EnginePicture changed(const std::function<float(float)>& change) {
  EnginePicture picture = rectangles(2);
  for (float& v : picture.rendering.mean.rgb) v = change(v);
  return picture;
}

TEST(PictureFault, is_a_shift_by_half_a_pixel) {
  const auto fault = picture_fault(rectangles(1), rectangles(2, 0.5));
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->pass, "camera");
  EXPECT_EQ(fault->sentence, "the picture is 0.5 px too far right");
}

TEST(PictureFault, is_another_tone_curve) {
  const auto fault = picture_fault(rectangles(1), changed([](float v) { return std::pow(v, 1 / 2.2f); }));
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->pass, "tone");
  EXPECT_NE(fault->sentence.find("gamma"), std::string::npos) << fault->sentence;
}

TEST(PictureFault, is_a_picture_that_is_turned_over) {
  const EnginePicture other = rectangles(2);
  EnginePicture turned = other;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        turned.rendering.mean.pixel(x, y)[c] = other.rendering.mean.pixel(x, kSide - 1 - y)[c];
  const auto fault = picture_fault(rectangles(1), turned);
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->pass, "camera");
}

TEST(PictureFault, is_none_where_a_part_is_darker_or_all_of_it_brighter) {
  EnginePicture darker = rectangles(2);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < 11; ++x)
      for (std::size_t c = 0; c < 3; ++c) darker.rendering.mean.pixel(x, y)[c] *= 0.5f;
  EXPECT_FALSE(picture_fault(rectangles(1), darker).has_value());
  EXPECT_FALSE(picture_fault(rectangles(1), changed([](float v) { return 1.1f * v; })).has_value());
  EXPECT_FALSE(picture_fault(rectangles(1), rectangles(2)).has_value());
}

TEST(DeclaredError, is_none_of_unbiased_engines_and_what_is_stated_of_others) {
  VerifyEngine engine;
  engine.row.name = "povray";
  engine.row.trust = Trust::unbiased;
  EXPECT_TRUE(declared_error(engine, std::nullopt, 0.5).is_exact());
  engine.row.trust = Trust::biased;
  EXPECT_EQ(declared_error(engine, std::nullopt, 0).whole, 0.01);
  EXPECT_EQ(declared_error(engine, std::nullopt, 0.03).whole, 0.03);
  Expect expect;
  expect.tolerances = {{"povray", "bias", 0.02, "its photon maps"}, {"povray", "ssim", 0.9, "no bias"}};
  const DeclaredError declared = declared_error(engine, expect, 0);
  EXPECT_EQ(declared.whole, 0.02);
  EXPECT_EQ(declared.reason, "its photon maps");
}

}  // namespace
}  // namespace photonproof::inline harness_verify
