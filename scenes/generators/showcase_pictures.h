// The textures of the scenes in scenes/showcase: paintings, woods, tiles and skies, all computed.
#pragma once

#include "scenes/images/image.h"

namespace photonproof::inline scenes_generators {

/// Colours are linear and from 0 to 1, so that a PNG holds them.
Image sunset_picture();   ///< a sun above the sea
Image ranges_picture();   ///< mountains behind mountains
Image blocks_picture();   ///< rectangles of flat colours between black bars
Image waves_picture();    ///< stripes that bend
Image julia_picture();    ///< the Julia set of -0.8 + 0.156 i
Image circles_picture();  ///< rings in squares
Image night_picture();    ///< a moon above lit windows
Image tiles_picture();    ///< 4 x 4 tiles of a pool with their joints
Image boards_picture();   ///< eight floorboards along u
Image boards_heights();   ///< their grain and joints, 0 to 1 as plain numbers
Image ball_picture();     ///< six coloured gores, for a sphere's uv
Image warm_gobo();        ///< three discs of light, red, amber and white, on black
Image cold_gobo();        ///< the same in blue, green and violet
Image evening_sky();      ///< radiance for an envmap: +y up, a soft sun low at -x, +z

}  // namespace photonproof::inline scenes_generators
