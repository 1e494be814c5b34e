#include "scenes/description/sun_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace photonproof::inline scenes_description {

Vec3d sun_direction(const PlaceAndTime& when) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double hours = when.hour - when.timezone_hours + (when.minute + when.second / 60) / 60;

  // Days since noon of 1 January 2000, universal time; integer divisions as in the paper.
  const int a = (when.month - 14) / 12;
  const int day = (1461 * (when.year + 4800 + a)) / 4 + (367 * (when.month - 2 - 12 * a)) / 12 -
                  (3 * ((when.year + 4900 + a) / 100)) / 4 + when.day - 32075;
  const double n = day - 0.5 + hours / 24 - 2451545.0;

  // Ecliptic coordinates, radians.
  const double omega = 2.1429 - 0.0010394594 * n;
  const double mean_longitude = 4.8950630 + 0.017202791698 * n;
  const double anomaly = 6.2400600 + 0.0172019699 * n;
  const double longitude = mean_longitude + 0.03341607 * std::sin(anomaly) + 0.00034894 * std::sin(2 * anomaly) -
                           0.0001134 - 0.0000203 * std::sin(omega);
  const double obliquity = 0.4090928 - 6.2140e-9 * n + 0.0000396 * std::cos(omega);

  // Celestial coordinates.
  const double right_ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));

  // Local coordinates: the zenith angle with its parallax, and the azimuth from north over east.
  const double sidereal_hours = 6.6974243242 + 0.0657098283 * n + hours;
  const double hour_angle = (sidereal_hours * 15 + when.longitude_degrees) * kDegree - right_ascension;
  const double latitude = when.latitude_degrees * kDegree;
  const double cos_zenith =
      std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) + std::sin(declination) * std::sin(latitude);
  double zenith = std::acos(std::clamp(cos_zenith, -1.0, 1.0));
  const double azimuth = std::atan2(
      -std::sin(hour_angle), std::tan(declination) * std::cos(latitude) - std::sin(latitude) * std::cos(hour_angle));
  constexpr double kEarthRadius = 6371.01, kAstronomicalUnit = 149597890;  // km
  zenith += kEarthRadius / kAstronomicalUnit * std::sin(zenith);

  return {-std::cos(azimuth) * std::sin(zenith), -std::sin(azimuth) * std::sin(zenith), std::cos(zenith)};
}

}  // namespace photonproof::inline scenes_description
