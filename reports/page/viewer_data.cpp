#include "reports/page/viewer_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "reports/page/pixel_data.h"
#include "reports/view/engine_style.h"
#include "reports/view/text.h"

namespace photonproof::reports::inline reports_page {
namespace {

using nlohmann::json;

json image_json(const SceneImage& image, const PixelData& pixels, const std::string& scene_id, std::size_t index) {
  json j = {{"title", printable(image.title)},
            {"caption", printable(image.caption)},
            {"isReference", image.is_reference},
            {"pixels", pixels.base64},
            {"maps", json::object()}};
  if (!pixels.flip_base64.empty()) j["flip"] = pixels.flip_base64;
  if (image.engine) {
    j["color"] = engine_color(*image.engine);
    j["shape"] = engine_style(*image.engine).svg_shape;
  }
  for (const auto& [role, file] : image.pictures) {
    if (role == "flip") j["maps"][role] = map_id(scene_id, index, role);
  }
  return j;
}

}  // namespace

std::string map_id(const std::string& scene_id, std::size_t image, const std::string& role) {
  return fmt::format("{}-image-{}-{}", scene_id, image, role);
}

std::vector<RankedTile> scene_tiles(const SceneView& scene) {
  std::vector<RankedTile> tiles;
  for (const GateRecord* gate : scene.gates) {
    for (const FailingTile& tile : gate->tiles) tiles.push_back({gate, &tile});
  }
  std::ranges::stable_sort(tiles, std::ranges::greater{}, [](const RankedTile& t) { return t.tile->score; });
  return tiles;
}

std::string viewer_json(const View& view, const SceneView& scene, const std::vector<SceneImage>& images,
                        const std::filesystem::path& folder, const std::string& id, std::size_t allowance) {
  std::vector<PixelSource> sources;
  for (const SceneImage& image : images) {
    const auto picture = image.pictures.find("image");
    const auto flip = image.pictures.find("flip");
    sources.push_back({image.image, picture == image.pictures.end() ? std::string() : picture->second,
                       flip == image.pictures.end() ? std::string() : flip->second});
  }
  const PixelDataSet set = pixel_data(folder, sources, scene.record.exposure, allowance);
  json shown = json::array(), notes = json::array();
  std::vector<std::optional<std::size_t>> place(images.size());  // in `shown`
  int width = 0, height = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const PixelData& pixels = set.images[i];
    if (pixels.base64.empty()) continue;
    if (width == 0) {
      width = pixels.width;
      height = pixels.height;
    } else if (width != pixels.width || height != pixels.height) {
      notes.push_back(printable(images[i].title) + " has another size and is left out.");
      continue;
    }
    if (pixels.from_picture) notes.push_back(printable(images[i].title) + " is from an 8-bit picture.");
    place[i] = shown.size();
    shown.push_back(image_json(images[i], pixels, id, i));
  }
  if (shown.empty()) return {};
  if (set.reduced_by > 1) {
    notes.push_back(fmt::format("To keep the page small, {0} × {0} pixels of the renders are averaged into one here.",
                                set.reduced_by));
  }
  json tiles = json::array();
  for (const RankedTile& ranked : scene_tiles(scene)) {
    const FailingTile& tile = *ranked.tile;
    json j = {{"x", tile.x},
              {"y", tile.y},
              {"width", tile.width},
              {"height", tile.height},
              {"sentence", printable(tile.sentence)}};
    const auto image = image_of_gate(images, view, *ranked.gate);
    if (image && place[*image]) j["image"] = *place[*image];
    tiles.push_back(j);
  }
  const json all = {{"name", printable(scene.record.name)},
                    {"exposure", scene.record.exposure},
                    {"width", width},
                    {"height", height},
                    {"reducedBy", set.reduced_by},
                    {"notes", notes},
                    {"images", shown},
                    {"tiles", tiles}};
  return json_in_html(all.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace photonproof::reports::inline reports_page
