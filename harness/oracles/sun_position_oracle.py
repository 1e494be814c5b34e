"""Where the sun stands, by another method than scenes/description/sun_position.cpp: prints what sun_position_test.cpp expects.

    python3 harness/oracles/sun_position_oracle.py

Meeus, "Astronomical Algorithms", 1998: Julian day (chapter 7), sidereal time (12), altitude and azimuth (13), nutation
(22, low accuracy) and the sun's apparent place (25, 0.01 degrees). The C++ has Blanco-Muriel et al. 2001 (0.5 minutes of
arc). Two published positions hold this script itself: Meeus's example 25.a and the worked example of NREL's Solar
Position Algorithm (Reda and Andreas 2004, table A5.1). Python's own library only.
"""
import math

AU_KM, EARTH_KM = 149597870.7, 6378.14


def julian_day(year, month, day):
    if month <= 2:
        year, month = year - 1, month + 12
    century = year // 100
    return math.floor(365.25 * (year + 4716)) + math.floor(30.6001 * (month + 1)) + day + 2 - century + century // 4 - 1524.5


def sin(degrees):
    return math.sin(math.radians(degrees))


def cos(degrees):
    return math.cos(math.radians(degrees))


def apparent_place(jd_dynamical):
    """Right ascension and declination, degrees; distance, astronomical units."""
    t = (jd_dynamical - 2451545) / 36525
    mean_longitude = 280.46646 + 36000.76983 * t + 0.0003032 * t * t
    anomaly = 357.52911 + 35999.05029 * t - 0.0001537 * t * t
    eccentricity = 0.016708634 - 0.000042037 * t
    centre = ((1.914602 - 0.004817 * t) * sin(anomaly) + (0.019993 - 0.000101 * t) * sin(2 * anomaly)
              + 0.000289 * sin(3 * anomaly))
    distance = 1.000001018 * (1 - eccentricity**2) / (1 + eccentricity * cos(anomaly + centre))
    omega = 125.04 - 1934.136 * t
    longitude = mean_longitude + centre - 0.00569 - 0.00478 * sin(omega)
    obliquity = 23 + 26 / 60 + 21.448 / 3600 - 46.8150 / 3600 * t + 0.00256 * cos(omega)
    ascension = math.degrees(math.atan2(cos(obliquity) * sin(longitude), cos(longitude))) % 360
    return ascension, math.degrees(math.asin(sin(obliquity) * sin(longitude))), distance


def seen_from(latitude, longitude_east, jd_universal, delta_t_seconds):
    """Zenith angle without refraction and azimuth from north over east, degrees."""
    ascension, declination, distance = apparent_place(jd_universal + delta_t_seconds / 86400)
    t = (jd_universal - 2451545) / 36525
    sidereal = 280.46061837 + 360.98564736629 * (jd_universal - 2451545) + 0.000387933 * t * t
    hour_angle = sidereal + longitude_east - ascension
    altitude = math.degrees(math.asin(sin(latitude) * sin(declination)
                                      + cos(latitude) * cos(declination) * cos(hour_angle)))
    azimuth = 180 + math.degrees(math.atan2(sin(hour_angle), cos(hour_angle) * sin(latitude)
                                            - math.tan(math.radians(declination)) * cos(latitude)))
    parallax = math.degrees(math.asin(EARTH_KM / (AU_KM * distance)) * cos(altitude))
    return 90 - altitude + parallax, azimuth % 360


# Rows: latitude, longitude, time zone, year, month, day, hour, minute, second, and TT - UT of the year in seconds.
CASES = [(35.6894, 139.6917, 9, 2010, 7, 10, 15, 0, 0, 66), (-33.87, 151.21, 10, 2024, 2, 29, 9, 17, 40, 69),
         (64.15, -21.94, 0, 2000, 4, 3, 19, 45, 0, 64), (-54.8, -68.3, -3, 1995, 10, 6, 7, 5, 30, 61),
         (27.7, 85.33, 5.75, 2033, 12, 31, 11, 30, 0, 75), (1.3, 103.8, 8, 2016, 5, 27, 12.5, 0, 0, 68)]


def main():
    ascension, declination, _ = apparent_place(2448908.5)  # Meeus: 198.38083, -7.78507
    assert abs(ascension - 198.38083) < 1e-4 and abs(declination + 7.78507) < 1e-4, (ascension, declination)
    # NREL: 17 October 2003, 12:30:30, -7 h, 39.742476 N, 105.1786 W: the altitude without refraction is 39.872046.
    jd = julian_day(2003, 10, 17) + (12.5 + 30 / 3600 + 7) / 24
    zenith, azimuth = seen_from(39.742476, -105.1786, jd, 67)
    assert abs(zenith - (90 - 39.872046)) < 0.01 and abs(azimuth - 194.34024) < 0.01, (zenith, azimuth)
    for latitude, longitude, zone, year, month, day, hour, minute, second, delta_t in CASES:
        jd = julian_day(year, month, day) + (hour - zone + minute / 60 + second / 3600) / 24
        zenith, azimuth = seen_from(latitude, longitude, jd, delta_t)
        print(f"      {{{{{latitude}, {longitude}, {zone}, {year}, {month}, {day}, {hour}, {minute}, {second}}}, "
              f"{zenith:.4f}, {azimuth:.4f}}},")


if __name__ == "__main__":
    main()
