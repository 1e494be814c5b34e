#include "reports/page/viewer_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

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

std::string viewer_json(const std::string& name, double exposure, const std::vector<SceneImage>& images,
                        const PixelDataSet& pixels, const std::string& id, const std::vector<ViewerTile>& tiles) {
  json shown = json::array(), notes = json::array();
  std::vector<std::optional<std::size_t>> place(images.size());  // in `shown`
  int width = 0, height = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const PixelData& own = pixels.images[i];
    if (own.base64.empty()) continue;
    if (width == 0) {
      width = own.width;
      height = own.height;
    } else if (width != own.width || height != own.height) {
      notes.push_back(printable(images[i].title) + " has another size and is left out.");
      continue;
    }
    if (own.from_picture) notes.push_back(printable(images[i].title) + " is from an 8-bit picture.");
    place[i] = shown.size();
    shown.push_back(image_json(images[i], own, id, i));
  }
  if (shown.empty()) return {};
  if (pixels.reduced_by > 1) {
    notes.push_back(fmt::format("To keep the page small, {0} × {0} pixels of the renders are averaged into one here.",
                                pixels.reduced_by));
  }
  json places = json::array();
  for (const auto& [tile, image] : tiles) {
    json j = {{"x", tile->x},
              {"y", tile->y},
              {"width", tile->width},
              {"height", tile->height},
              {"sentence", printable(tile->sentence)}};
    if (image && place[*image]) j["image"] = *place[*image];
    places.push_back(j);
  }
  const json all = {{"name", printable(name)},        {"exposure", exposure}, {"width", width},  {"height", height},
                    {"reducedBy", pixels.reduced_by}, {"notes", notes},       {"images", shown}, {"tiles", places}};
  return json_in_html(all.dump(-1, ' ', false, json::error_handler_t::replace));
}

std::string viewer_json(const View& view, const SceneView& scene, const std::vector<SceneImage>& images,
                        const std::filesystem::path& folder, const std::string& id, std::size_t allowance) {
  std::vector<PixelSource> sources;
  for (const SceneImage& image : images) {
    sources.push_back({image.image, picture_file(image.pictures, "image"), picture_file(image.pictures, "flip")});
  }
  const double exposure = scene.record.exposure;
  std::vector<ViewerTile> tiles;
  for (const RankedTile& ranked : scene_tiles(scene))
    tiles.push_back({ranked.tile, image_of_gate(images, view, *ranked.gate)});
  return viewer_json(scene.record.name, exposure, images, pixel_data(folder, sources, exposure, allowance), id, tiles);
}

}  // namespace photonproof::reports::inline reports_page
