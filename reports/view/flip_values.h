// Reads the values of a FLIP map from the colours of its picture (harness/metrics/heatmap.h), for the page's viewer.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scenes/images/image.h"

namespace photonproof::reports::inline reports_view {

/// FLIP in every channel, a multiple of 1/255 as in the picture. Empty if there is no such file, or if one of its
/// colours is not magma's. `relative` as for embed_thumbnail.
std::optional<Image> flip_values(const std::filesystem::path& folder, const std::string& relative);

/// The first channel in steps of 1/255, deflated (zlib's format). Each byte is the difference to its left pixel modulo
/// 256.
std::string packed_flip(const Image& values);

}  // namespace photonproof::reports::inline reports_view
