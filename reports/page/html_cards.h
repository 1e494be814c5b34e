// The gallery of a scene: one card per image with its heat maps. Print and pages without JavaScript show only the
// gallery.
#pragma once

#include <filesystem>
#include <kainjow/mustache.hpp>
#include <string>
#include <vector>

#include "reports/page/scene_images.h"

namespace photonproof::reports::inline reports_page {

struct Gallery {
  kainjow::mustache::data cards;  ///< a list for scene_section.mustache
  std::size_t bytes = 0;          ///< of the pictures, in base64
  int longest_side = 0;           ///< pixels; pictures were reduced to it, 0 when none was
};

/// Pictures are reduced as far as is needed for all together to stay within `allowance` bytes.
Gallery gallery(const View& view, const SceneView& scene, const std::vector<SceneImage>& images,
                const std::filesystem::path& folder, const std::string& scene_id, std::size_t allowance);

}  // namespace photonproof::reports::inline reports_page
