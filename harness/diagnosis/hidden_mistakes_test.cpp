// Patterns that no bound detects: found only where they are there in full, and never named. Renders nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/diagnosis/diagnosis.h"
#include "harness/diagnosis/pictures/picture_changes.h"
#include "harness/diagnosis/test_defects.h"
#include "scenes/base/splitmix.h"

namespace photonproof::inline harness_diagnosis {
namespace {

constexpr int side = 64;

/// Noise from -1 to 1, without a pattern.
float noise(std::uint64_t seed, std::size_t value) {
  return static_cast<float>(static_cast<double>(splitmix64(seed, value) % 20001) / 10000 - 1);
}

/// Ripples across the lower half, a tenth of the light there.
Image ripples(std::uint64_t seed) {
  Image image(side, side);
  for (std::size_t i = image.pixels() / 2; i < image.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * i + c] = 0.04f * noise(seed, i);
  return image;
}

Image level() {
  Image image(side, side);
  for (float& v : image.rgb) v = 0.4f;
  return image;
}

SceneKnowledge with_waves() {
  SceneKnowledge knowledge;
  knowledge.reference = level();
  knowledge.white = 1.0f;
  WhatIf flat{"water-flat", "the water is flat", "", "", Lazy<Image>(level())};
  flat.fine = Lazy<Image>(ripples(1));
  knowledge.what_ifs.push_back(flat);
  return knowledge;
}

/// The noise is four times as strong as the pattern is after photons are gathered around each pixel.
Image submitted(double amount, std::uint64_t pattern, std::uint64_t seed) {
  Image image = level();
  const Image change = blurred(ripples(pattern), 0.02 * side);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] += static_cast<float>(amount) * change.rgb[i] + 0.012f * noise(seed, i);
  return as_bytes(image);
}

std::string kind_of(const std::vector<Finding>& findings) {
  EXPECT_LE(findings.size(), 1u);
  return findings.empty() ? "none" : findings.front().kind;
}

TEST(HiddenMistakes, a_pattern_that_is_there_in_full_is_told_and_nothing_else_is) {
  const SceneKnowledge knowledge = with_waves();
  for (const std::uint64_t seed : {11, 12, 13, 14, 15, 16, 17, 18}) {
    EXPECT_EQ(kind_of(find_hidden_mistake(submitted(1, 1, seed), knowledge)), "differs") << seed;
    EXPECT_EQ(kind_of(find_hidden_mistake(submitted(0, 1, seed), knowledge)), "none") << seed;
    EXPECT_EQ(kind_of(find_hidden_mistake(submitted(1, 2, seed), knowledge)), "none") << "another pattern " << seed;
    EXPECT_EQ(kind_of(find_hidden_mistake(submitted(-1, 1, seed), knowledge)), "none") << "the contrary " << seed;
    EXPECT_EQ(kind_of(find_hidden_mistake(submitted(0.4, 1, seed), knowledge)), "none") << "a part of it " << seed;
  }
}

TEST(HiddenMistakes, what_one_body_looks_like_is_told_where_it_is_seen) {
  SceneKnowledge knowledge = with_waves();
  WhatIf bright{"mirror-untinted", "the mirror is too bright", "", "", {}};
  Image brighter = level();
  bright.changes.resize(brighter.pixels());
  for (std::size_t i = 10 * side; i < 20 * side; ++i) {
    if (i % side < 20 || i % side >= 30) continue;
    bright.changes[i] = 1;
    for (std::size_t c = 0; c < 3; ++c) brighter.rgb[3 * i + c] = 0.48f;
  }
  bright.image = Lazy<Image>(brighter);
  bright.only_there = true;
  knowledge.what_ifs.push_back(bright);
  Image image = submitted(0, 1, 31);
  EXPECT_EQ(kind_of(find_hidden_mistake(image, knowledge)), "none");
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    if (bright.changes[i / 3] != 0) image.rgb[i] += 0.08f;
  EXPECT_EQ(kind_of(find_hidden_mistake(image, knowledge)), "differs");
}

TEST(HiddenMistakes, broad_changes_are_for_the_bounds) {
  SceneKnowledge knowledge = with_waves();
  Image dark = level(), darker = submitted(0, 1, 21);
  for (float& v : dark.rgb) v *= 0.9f;
  for (float& v : darker.rgb) v *= 0.9f;
  knowledge.what_ifs.push_back({"lamp-part", "the lamp is too small", "", "", Lazy<Image>(dark)});
  EXPECT_EQ(kind_of(find_hidden_mistake(darker, knowledge)), "none");
}

TEST(HiddenMistakes, pictures_that_cannot_be_compared_have_none) {
  const SceneKnowledge knowledge = with_waves();
  EXPECT_EQ(kind_of(find_hidden_mistake(Image(side, side - 1), knowledge)), "none");
  Image broken = submitted(1, 1, 11);
  broken.rgb[7] = std::nanf("");
  EXPECT_EQ(kind_of(find_hidden_mistake(broken, knowledge)), "none");
}

}  // namespace
}  // namespace photonproof::inline harness_diagnosis
