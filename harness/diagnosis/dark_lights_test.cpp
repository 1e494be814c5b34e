#include "harness/diagnosis/dark_lights.h"

#include <gtest/gtest.h>

namespace photonproof::inline harness_diagnosis {
namespace {

/// A grey image with a light of 4 x 2 pixels.
Image room(float light) {
  Image image(24, 24);
  for (float& v : image.rgb) v = 0.3f;
  for (int y = 2; y < 4; ++y)
    for (int x = 10; x < 14; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = light;
  return image;
}

SceneKnowledge of_room(std::optional<float> white) {
  SceneKnowledge knowledge;
  knowledge.reference = room(1);
  knowledge.white = white;
  return knowledge;
}

TEST(DarkLights, are_found_where_white_comes_out_dark) {
  const std::optional<Finding> found = find_dark_lights(room(0.6f), of_room(1));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, "white-is-dark");
  EXPECT_EQ(found->where.x, 10);
  EXPECT_EQ(found->where.y, 2);
}

TEST(DarkLights, are_none_where_lights_are_white_or_pictures_are_not_cut) {
  EXPECT_FALSE(find_dark_lights(room(1), of_room(1)));
  EXPECT_FALSE(find_dark_lights(room(0.97f), of_room(1)));
  EXPECT_FALSE(find_dark_lights(room(0.6f), of_room(std::nullopt)));
  SceneKnowledge unlit = of_room(1);
  unlit.reference = room(0.3f);
  EXPECT_FALSE(find_dark_lights(room(0.1f), unlit));
}

// The light's few pixels are all edge, where blocks show nothing.
TEST(DarkLights, are_said_by_diagnosis_where_it_finds_nothing_else) {
  const std::vector<Finding> findings = diagnose(room(0.8f), of_room(1));
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.front().kind, "white-is-dark");
}

}  // namespace
}  // namespace photonproof::inline harness_diagnosis
