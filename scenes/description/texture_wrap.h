// How values on grids continue between and beyond their samples.
#pragma once

namespace photonproof::inline scenes_description {

enum class TextureFilter { bilinear, nearest };
enum class TextureWrap { repeat, mirror, clamp };

}  // namespace photonproof::inline scenes_description
