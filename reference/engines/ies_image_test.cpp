// The image of an IES file's candela at angles whose values are known.
#include "reference/engines/ies_image.h"

#include <gtest/gtest.h>

namespace photonproof::inline reference_engines {
namespace {

/// At degrees from the nadir and around.
float candela(const Image& image, int vertical, int horizontal) {
  return image.pixel(horizontal % 360, vertical * (image.height - 1) / 180)[0];
}

TEST(IesImage, is_linear_between_angles_and_dark_beyond_them) {
  const Image image = ies_image({{0, 40, 90}, {0}, {10, 20, 70}});
  EXPECT_FLOAT_EQ(candela(image, 0, 123), 10);
  EXPECT_FLOAT_EQ(candela(image, 20, 0), 15);
  EXPECT_FLOAT_EQ(candela(image, 65, 359), 45);
  EXPECT_FLOAT_EQ(candela(image, 90, 7), 70);
  EXPECT_FLOAT_EQ(candela(image, 91, 7), 0);
}

// A value v at 0 degrees around and 90 + v at 90: a quadrant is seen four times, mirrored.
TEST(IesImage, quadrants_and_halves_are_mirrored) {
  const Image quadrant = ies_image({{0, 180}, {0, 90}, {0, 0, 90, 90}});
  for (const int around : {30, 150, 210, 330}) EXPECT_FLOAT_EQ(candela(quadrant, 50, around), 30);
  const Image half = ies_image({{0, 180}, {0, 180}, {0, 0, 180, 180}});
  for (const int around : {100, 260}) EXPECT_FLOAT_EQ(candela(half, 50, around), 100);
  const Image whole = ies_image({{0, 180}, {0, 360}, {0, 0, 360, 360}});
  EXPECT_FLOAT_EQ(candela(whole, 50, 260), 260);
}

}  // namespace
}  // namespace photonproof::inline reference_engines
