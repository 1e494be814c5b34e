// Spectra over wavelengths as linear RGB, by the rule of Mitsuba 3's rgb variants.
#pragma once

#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_description {

struct SpectrumSample {
  double wavelength;  ///< nm
  double value;
};

/// The kind of a spectrum decides its conversion to a colour. A reflectance is lit by CIE illuminant D65, so that a
/// constant one is grey. An emission is converted directly by the CIE 1931 observer, so that equal values at all
/// wavelengths are pinkish.
enum class SpectrumKind { reflectance, emission };

/// The colour of a spectrum that is linear between `samples` (at least two, ascending) and zero outside. It covers 360
/// to 830 nm; an `emission` of constant 1 has the luminance 1. Negative components, of colours outside Rec. 709, become
/// 0.
RgbD rgb_of_spectrum(const std::vector<SpectrumSample>& samples, SpectrumKind kind);

/// The integral over wavelength, nm, that a unit of Y stands for in rgb_of_spectrum's colours of emission.
inline constexpr double cie_y_integral = 106.7502593994140625;

/// Linear Rec. 709 of CIE XYZ, negative outside of its gamut.
RgbD rgb_of_xyz(const Vec3d& xyz);

}  // namespace photonproof::inline scenes_description
