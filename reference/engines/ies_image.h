// The distribution of an IES file as an image, for engines that read no such file.
#pragma once

#include "scenes/images/image.h"
#include "scenes/meshes/ies.h"

namespace photonproof::inline reference_engines {

/// Candela, equal in all channels. Columns are at 0, 360/width, ... degrees around; rows go from the nadir at 0 to the
/// zenith at 180 degrees. Values are linear between the file's angles and 0 outside its vertical ones. Between rows and
/// columns they are linear again, which is exact where the file's angles are multiples of 1/8 and 1 degree.
Image ies_image(const IesProfile& profile);

}  // namespace photonproof::inline reference_engines
