// What the page's viewer of a scene (templates/viewer*.js) is given, as JSON.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/page/scene_images.h"

namespace photonproof::reports::inline reports_page {

/// {"name", "exposure", "width", "height", "reducedBy", "notes": [...],
///  "images": [{"title", "caption", "color", "shape", "isReference", "pixels", "flip", "maps": {"flip": id of the
///  <img>}}], "tiles": [{"x", "y", "width", "height", "image", "sentence"}]}
/// or an empty text when no image can be shown. Images of another size than the first are left out, which a
/// note says. `id` is the scene's on the page; the pixels take at most `allowance` bytes.
std::string viewer_json(const View& view, const SceneView& scene, const std::vector<SceneImage>& images,
                        const std::filesystem::path& folder, const std::string& id, std::size_t allowance);

/// The id of the <img> of a map: "scene-1-image-2-flip".
std::string map_id(const std::string& scene_id, std::size_t image, const std::string& role);

/// The failing tiles of a scene, worst first; the viewer knows them by their place in this list.
std::vector<RankedTile> scene_tiles(const SceneView& scene);

}  // namespace photonproof::reports::inline reports_page
