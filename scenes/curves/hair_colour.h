// The colour of hair from what absorbs light in it.
#pragma once

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_curves {

/// Absorption per hair's radius of these concentrations of the two pigments: d'Eon et al. 2011, "An energy-conserving
/// hair reflectance model", table 2, in RGB.
RgbD absorption_of_pigments(double eumelanin, double pheomelanin);

/// Reflectance of a volume of hair of this absorption: Chiang et al. 2016, "A practical and controllable hair and fur
/// model for production path tracing", equation 9 solved for it. `roughness` is the azimuthal one, from 0 to 1.
RgbD colour_of_hair(const RgbD& absorption, double roughness);

}  // namespace photonproof::inline scenes_curves
