#include "harness/pixels/display.h"

#include <gtest/gtest.h>

#include <cmath>

namespace photonproof::inline harness_pixels {
namespace {

TEST(Display, srgb_matches_the_standards_fixed_points) {
  // IEC 61966-2-1: 12.92 v below 0.0031308, 1.055 v^(1/2.4) - 0.055 above; 0.5 encodes to 0.735357.
  EXPECT_EQ(encode_srgb(0.0), 0);
  EXPECT_NEAR(encode_srgb(1.0), 1, 1e-15);
  EXPECT_DOUBLE_EQ(encode_srgb(0.001), 0.01292);
  EXPECT_NEAR(encode_srgb(0.5), 0.7353569831, 1e-9);
}

TEST(Display, decoding_undoes_encoding) {
  // The two branches of the standard meet only to 3e-8 and 0.0031308 encodes to within 1e-8 of 0.04045.
  for (int i = 0; i <= 1000; ++i) {
    const double v = i / 1000.0;
    EXPECT_NEAR(decode_srgb(encode_srgb(v)), v, 1e-7);
  }
}

TEST(Display, exposure_scales_by_powers_of_two_and_clamps) {
  Image image(2, 1);
  image.rgb = {0.25f, 0.5f, 3, -1, 0, 1e30f};
  EXPECT_EQ(expose(image, 1), (std::vector<double>{0.5, 1, 1, 0, 0, 1}));
  EXPECT_EQ(expose(image, -2), (std::vector<double>{0.0625, 0.125, 0.75, 0, 0, 1}));
}

}  // namespace
}  // namespace photonproof::inline harness_pixels
