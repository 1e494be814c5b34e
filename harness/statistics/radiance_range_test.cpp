#include "harness/statistics/radiance_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace photonproof::inline harness_statistics {
namespace {

Image of(float radiance) {
  Image image(2, 1);
  image.rgb[4] = radiance;
  return image;
}

TEST(RadianceRange, holds_what_has_a_variance) {
  for (const float ordinary : {0.0f, 1.0f, -1.0f, 2e-15f, 9e18f}) {
    EXPECT_EQ(why_variance_is_lost(of(ordinary)), "") << ordinary;
    const float variance = ordinary * ordinary * 1e-8f;
    EXPECT_TRUE(ordinary == 0 || std::isnormal(variance)) << ordinary;
  }
}

TEST(RadianceRange, says_what_is_beyond) {
  EXPECT_EQ(why_variance_is_lost(of(2e20f)),
            "has radiances of 2e+20. Single precision holds the variance of radiances from 1e-15 to 1e+19: give the "
            "scene's lights in another unit");
  EXPECT_NE(why_variance_is_lost(of(-2e20f)), "");
  EXPECT_NE(why_variance_is_lost(of(5e-16f)), "");
  EXPECT_NE(why_variance_is_lost(of(std::numeric_limits<float>::denorm_min())), "");
}

}  // namespace
}  // namespace photonproof::inline harness_statistics
