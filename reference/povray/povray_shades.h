// Small filtering balls around point lights. They give a light a distribution that POV-Ray's own lights lack.
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline reference_povray {

/// Transmits 1 within the beam, 0 beyond the cut-off, linear in the angle between.
std::string spot_shade(const SpotLightDescription& light, double scale);
/// A second ball around that one for the spot's texture, whose channels are at most `greatest`. It fills the square
/// about the cone at the cut-off.
std::string slide_shade(const SpotLightDescription& light, double greatest, double scale);

/// Transmits the table's candela over the greatest, linear in both angles between its own.
std::string ies_shade(const IesLightDescription& light, double scale);
double greatest_candela(const IesProfile& profile);

}  // namespace photonproof::inline reference_povray
