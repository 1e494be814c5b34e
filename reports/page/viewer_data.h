// The JSON input of the page's viewer of a scene (templates/viewer*.js).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/page/pixel_data.h"
#include "reports/page/scene_images.h"

namespace photonproof::reports::inline reports_page {

/// A tile that the viewer can go to.
struct ViewerTile {
  const FailingTile* tile = nullptr;
  std::optional<std::size_t> image{};  ///< index of the image that shows it
};

/// JSON of the viewer, where the id is that of an <img>:
///   {"name", "exposure", "width", "height", "reducedBy", "notes": [...],
///    "images": [{"title", "caption", "color", "shape", "isReference", "pixels", "flip", "maps": {"flip": id}}],
///    "tiles": [{"x", "y", "width", "height", "image", "sentence"}]}
/// Empty when no image can be shown. Images of another size than the first are left out, with a note. `pixels` has one
/// entry for each image, and `id` is the scene's on the page.
std::string viewer_json(const std::string& name, double exposure, const std::vector<SceneImage>& images,
                        const PixelDataSet& pixels, const std::string& id, const std::vector<ViewerTile>& tiles);

/// The same of a scene's images in `folder`. The pixels take at most `allowance` bytes.
std::string viewer_json(const View& view, const SceneView& scene, const std::vector<SceneImage>& images,
                        const std::filesystem::path& folder, const std::string& id, std::size_t allowance);

/// The id of the <img> of a map: "scene-1-image-2-flip".
std::string map_id(const std::string& scene_id, std::size_t image, const std::string& role);

/// The failing tiles of a scene, worst first; the viewer refers to them by their index in this list.
std::vector<RankedTile> scene_tiles(const SceneView& scene);

}  // namespace photonproof::reports::inline reports_page
