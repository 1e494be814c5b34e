// Smaller copies of images, for pages with a limit on their size.
#pragma once

#include "scenes/images/image.h"

namespace photonproof::reports::inline reports_page {

/// Averages blocks of factor x factor pixels; blocks at the right and bottom edges may be smaller.
Image reduced_image(const Image& image, int factor);

}  // namespace photonproof::reports::inline reports_page
