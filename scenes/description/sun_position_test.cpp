#include "scenes/description/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace photonproof::inline scenes_description {
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
  EXPECT_LT(morning.y, -0.9);
  EXPECT_GT(evening.y, 0.9);
  EXPECT_NEAR(morning.x, 0, 0.02);
  EXPECT_NEAR(length(morning), 1, 1e-12);
}

TEST(sun_position, knows_time_zones) {
  const Vec3d tokyo = sun_direction({}), utc = sun_direction({35.6894, 139.6917, 0, 2010, 7, 10, 6, 0, 0});
  EXPECT_NEAR(length(tokyo - utc), 0, 1e-12);
  EXPECT_GT(tokyo.y, 0) << "the afternoon sun is in the west";
}

struct Place {
  PlaceAndTime when;
  double zenith, azimuth;  ///< in degrees, without refraction; the azimuth from north over east
};

void expect_there(const Place& place) {
  const Vec3d sun = sun_direction(place.when);
  SCOPED_TRACE(place.when.latitude_degrees);
  EXPECT_NEAR(std::acos(sun.z) / kDegree, place.zenith, 0.02);
  const double azimuth = std::atan2(-sun.y, -sun.x) / kDegree;
  EXPECT_NEAR(std::remainder(azimuth - place.azimuth, 360) * std::sin(place.zenith * kDegree), 0, 0.02);
}

TEST(sun_position, is_where_published_almanacs_have_it) {
  // Reda and Andreas, "Solar Position Algorithm for Solar Radiation Applications" (NREL, 2004), table A5.1. On 17
  // October 2003, 12:30:30, seven hours before Greenwich, the altitude without refraction is 39.872046 degrees, the
  // azimuth 194.340241.
  expect_there({{39.742476, -105.1786, -7, 2003, 10, 17, 12, 30, 30}, 90 - 39.872046, 194.340241});
  // Meeus, "Astronomical Algorithms", example 25.b: 13 October 1992, 0:00 dynamical time, one minute after midnight UT.
  // The declination -7.78507 degrees is the altitude over the pole, less a parallax of 0.0024.
  EXPECT_NEAR(elevation({90, 0, 0, 1992, 10, 12, 23, 59, 1}), -7.78507 - 0.0024, 0.005);
}

TEST(sun_position, is_where_another_method_finds_it) {
  // harness/oracles/sun_position_oracle.py (Meeus). The two agree to 0.02 degrees, a 25th of the sun's width.
  // Midway between the seasons of its fastest and slowest motion, 2 % of the equation of centre are 0.04.
  for (const Place& place : {Place{{35.6894, 139.6917, 9, 2010, 7, 10, 15, 0, 0}, 43.9152, 265.7486},
                             Place{{-33.87, 151.21, 10, 2024, 2, 29, 9, 17, 40}, 46.9457, 66.3334},
                             Place{{64.15, -21.94, 0, 2000, 4, 3, 19, 45, 0}, 86.4501, 275.6517},
                             Place{{-54.8, -68.3, -3, 1995, 10, 6, 7, 5, 30}, 88.2047, 96.1506},
                             Place{{27.7, 85.33, 5.75, 2033, 12, 31, 11, 30, 0}, 51.5338, 169.2103},
                             Place{{1.3, 103.8, 8, 2016, 5, 27, 12.5, 0, 0}, 21.5218, 20.6739}})
    expect_there(place);
}

TEST(sun_position, is_where_mitsuba_has_it) {
  // harness/oracles/sky_oracle.py, Mitsuba 3.9.1's `sun_direction`, to 0.03 degrees: days in single precision are a
  // quarter of a day off.
  const auto expect_direction = [](const PlaceAndTime& when, const Vec3d& expected) {
    EXPECT_NEAR(length(sun_direction(when) - expected), 0, 5e-4) << when.hour;
  };
  expect_direction({}, {0.0513854, 0.691748, 0.720308});
  expect_direction({35.6894, 139.6917, 9, 2010, 7, 10, 9, 0, 0}, {0.0956952, -0.614786, 0.782867});
  expect_direction({35.6894, 139.6917, 9, 2010, 1, 20, 12, 0, 0}, {0.827548, 0.0323665, 0.560461});
  expect_direction({-33.9, 151.2, 10, 2010, 7, 10, 9.5, 0, 0}, {-0.723397, -0.56492, 0.39694});
}

TEST(sun_position, defaults_are_a_summer_afternoon_in_tokyo) {
  EXPECT_NEAR(length(sun_direction({}) - sun_direction({35.6894, 139.6917, 9, 2010, 7, 10, 15, 0, 0})), 0, 1e-12);
}

}  // namespace
}  // namespace photonproof::inline scenes_description
