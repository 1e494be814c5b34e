// The distribution of an IES file as an image, which Cycles can look up.
#pragma once

#include "scenes/images/image.h"
#include "scenes/meshes/ies.h"

namespace photonproof::inline reference_cycles {

/// Candela, the same in all channels: columns at 0, 360/width, ... degrees around, rows from the nadir at 0 to the
/// zenith at 180 degrees, linear between the file's angles, 0 outside of its vertical ones. What lies between the rows
/// and columns is linear again, and the file's own where its angles are multiples of 1/8 and 1 degree.
Image ies_image(const IesProfile& profile);

}  // namespace photonproof::inline reference_cycles
