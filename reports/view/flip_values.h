// The values of a FLIP map, back from the colours of its picture (harness/metrics/heatmap.h), for the page's viewer.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scenes/images/image.h"

namespace photonproof::reports::inline reports_view {

/// FLIP in every channel, a multiple of 1/255 as the picture has it. Empty where there is no such file, or where one of
/// its colours is not magma's. `relative` as for embed_thumbnail.
std::optional<Image> flip_values(const std::filesystem::path& folder, const std::string& relative);

/// The first channel in steps of 1/255, each byte the difference to the pixel on its left modulo 256; zlib's bytes.
std::string packed_flip(const Image& values);

}  // namespace photonproof::reports::inline reports_view
