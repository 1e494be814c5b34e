#include "scenes/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace photonproof {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double elevation(const PlaceAndTime& when) { return std::asin(sun_direction(when).z) / kDegree; }

TEST(sun_position, is_in_the_zenith_of_the_tropics_at_the_solstices) {
  // 21 June 2010, 11:28 UTC was the northern solstice: the declination was 23.44 degrees. The sun crosses the meridian
  // of Greenwich at noon plus the equation of time, 1.8 minutes.
  const PlaceAndTime tropic{23.44, 0, 0, 2010, 6, 21, 12, 1.8, 0};
  EXPECT_NEAR(elevation(tropic), 90, 0.1);
  const PlaceAndTime pole{90, 0, 0, 2010, 6, 21, 12, 0, 0};
  EXPECT_NEAR(elevation(pole), 23.44, 0.02);
}

TEST(sun_position, rises_in_the_east_and_sets_in_the_west_at_the_equinox) {
  // 20 March 2010, 17:32 UTC; at the equator the day lasts from 6:07 to 18:07 solar time.
  const Vec3d morning = sun_direction({0, 0, 0, 2010, 3, 20, 7, 0, 0}),
              evening = sun_direction({0, 0, 0, 2010, 3, 20, 17, 0, 0});
  EXPECT_GT(morning.y, 0.9);
  EXPECT_LT(evening.y, -0.9);
  EXPECT_NEAR(morning.x, 0, 0.02);
  EXPECT_NEAR(length(morning), 1, 1e-12);
}

TEST(sun_position, knows_time_zones) {
  const Vec3d tokyo = sun_direction({}), utc = sun_direction({35.6894, 139.6917, 0, 2010, 7, 10, 6, 0, 0});
  EXPECT_NEAR(length(tokyo - utc), 0, 1e-12);
  EXPECT_LT(tokyo.y, 0) << "the afternoon sun is in the west";
}

}  // namespace
}  // namespace photonproof
