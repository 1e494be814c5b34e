"""Sunlight on the ground by wavelength: prints what sky_test.cpp expects of scenes/sky/sun_spectrum.cpp.

    python3 harness/oracles/sun_spectrum_oracle.py

Written from appendix A.1 of Preetham, Shirley and Smits 1999 and, for the tables, from Iqbal, "An Introduction to Solar
Radiation", 1983, which it takes them from: ozone every 5 nm (p. 127), water vapour (p. 130). The sun above the air in
W m^-2 sr^-1 nm^-1. Colours by the CIE's functions as printed every 10 nm (CIE 15) and a matrix inverted from Rec. 709's
primaries, where the C++ integrates over 1000 steps. Python's own library only.
"""
import math

from sky_oracle import TO_RGB, Y_INTEGRAL, times

WAVELENGTHS = list(range(380, 751, 10))
SUN = [16559.0, 16233.7, 21127.5, 25888.2, 25829.1, 24232.3, 26760.5, 29658.3, 30545.4, 30057.5, 30663.7, 28830.4, 28712.1,
       27825.0, 27100.6, 27233.6, 26361.3, 25503.8, 25060.2, 25311.6, 25355.9, 25134.2, 24631.5, 24173.2, 23685.3, 23212.1,
       22827.7, 22339.8, 21970.2, 21526.7, 21097.9, 20728.3, 20240.4, 19870.8, 19427.2, 19072.4, 18628.9, 18259.2]
OZONE = {445: .003, 450: .003, 455: .004, 460: .006, 465: .008, 470: .009, 475: .012, 480: .014, 485: .017, 490: .021,
         495: .025, 500: .030, 505: .035, 510: .040, 515: .045, 520: .048, 525: .057, 530: .063, 535: .070, 540: .075,
         545: .080, 550: .085, 555: .095, 560: .103, 565: .110, 570: .120, 575: .122, 580: .120, 585: .118, 590: .115,
         595: .120, 600: .125, 605: .130, 610: .120, 620: .105, 630: .090, 640: .079, 650: .067, 660: .057, 670: .048,
         680: .036, 690: .028, 700: .023, 710: .018, 720: .014, 730: .011, 740: .010, 750: .009}
WATER = {690: .016, 700: .024, 710: .0125, 720: 1.00, 730: .87, 740: .061, 750: .001}
# CIE 1931, 380 to 750 nm.
X = [.0014, .0042, .0143, .0435, .1344, .2839, .3483, .3362, .2908, .1954, .0956, .0320, .0049, .0093, .0633, .1655, .2904,
     .4334, .5945, .7621, .9163, 1.0263, 1.0622, 1.0026, .8544, .6424, .4479, .2835, .1649, .0874, .0468, .0227, .0114,
     .0058, .0029, .0014, .0007, .0003]
Y = [.0000, .0001, .0004, .0012, .0040, .0116, .0230, .0380, .0600, .0910, .1390, .2080, .3230, .5030, .7100, .8620, .9540,
     .9950, .9950, .9520, .8700, .7570, .6310, .5030, .3810, .2650, .1750, .1070, .0610, .0320, .0170, .0082, .0041, .0021,
     .0010, .0005, .0002, .0001]
Z = [.0065, .0201, .0679, .2074, .6456, 1.3856, 1.7471, 1.7721, 1.6692, 1.2876, .8130, .4652, .2720, .1582, .0782, .0422,
     .0203, .0087, .0039, .0021, .0017, .0011, .0008, .0003, .0002] + [0] * 13


def ozone(nm):
    """Linear between the rows; from 355 nm, where it is 0, to 445 nm there are none, and 440 nm rounds to the latter."""
    return .003 if nm == 440 else OZONE.get(nm, 0)


def air_mass(zenith_degrees):
    return (math.cos(math.radians(zenith_degrees)) + 0.15 * (93.885 - zenith_degrees)**-1.253)**-1


def transmittances(nm, mass, turbidity):
    um = nm * 1e-3
    depth = WATER.get(nm, 0) * 2 * mass
    return (math.exp(-mass * 0.008735 / um**4.08), math.exp(-mass * (0.04608 * turbidity - 0.04586) / um**1.3),
            math.exp(-mass * ozone(nm) * 0.35), math.exp(-0.2385 * depth * (1 + 20.07 * depth)**-0.45))


def spectrum(zenith_degrees, turbidity):
    mass = air_mass(zenith_degrees)
    return [value * math.prod(transmittances(nm, mass, turbidity)) for nm, value in zip(WAVELENGTHS, SUN)]


def xyz(radiance):
    return [10 * math.fsum(r * c for r, c in zip(radiance, curve)) for curve in (X, Y, Z)]


def main():
    for zenith, turbidity in ((0, 2), (60, 3), (80, 6), (75, 1)):
        print(f"zenith {zenith}, turbidity {turbidity}, air mass {air_mass(zenith):.7g}")
        words = [f"{x:.6g}" for x in spectrum(zenith, turbidity)]
        for i in range(0, len(words), 12):
            print("       " + ", ".join(words[i:i + 12]) + ",")
        print("   rgb " + ", ".join(f"{x:.5g}" for x in (v / Y_INTEGRAL for v in times(TO_RGB, xyz(spectrum(zenith, turbidity))))))
    for nm, mass, turbidity in ((400, 1, 2), (450, 2, 4), (550, 1, 3), (600, 5, 8), (700, 2, 1), (720, 3, 2), (730, 1, 2)):
        print(f"      {{{nm}, {mass}, {turbidity}, " + ", ".join(f"{t:.8f}" for t in transmittances(nm, mass, turbidity)) + "},")
    # Illuminance facing the sun, lux.
    solid_angle = 2 * math.pi * (1 - math.cos(math.radians(0.5358 / 2)))
    print(f"above the air {683.002 * xyz(SUN)[1] * solid_angle:.0f} lx")
    for zenith in (30, 60, 75):
        print(f"zenith {zenith}, turbidity 2: {683.002 * xyz(spectrum(zenith, 2))[1] * solid_angle:.0f} lx; the IESNA's clear sky:"
              f" {127500 * math.exp(-0.21 * air_mass(zenith)):.0f} lx")


if __name__ == "__main__":
    main()
