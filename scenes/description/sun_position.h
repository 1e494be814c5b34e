// The sun's position. Source: Blanco-Muriel, Alarcon-Padilla, Lopez-Moratalla and Lara-Coira 2001, "Computing the solar
// vector", Solar Energy 70(5). The error is below half a minute of arc from 1999 to 2015.
#pragma once

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_description {

/// Local time at a place; the defaults are Mitsuba's, an afternoon in Tokyo.
struct PlaceAndTime {
  double latitude_degrees = 35.6894;    ///< north is positive
  double longitude_degrees = 139.6917;  ///< east is positive
  double timezone_hours = 9;            ///< ahead of UTC
  int year = 2010, month = 7, day = 10;
  double hour = 15, minute = 0, second = 0;
};

/// Unit vector towards the sun: +x is south, +y west, +z up, as in Mitsuba. Below the horizon z is negative.
Vec3d sun_direction(const PlaceAndTime& when);

}  // namespace photonproof::inline scenes_description
