#include "reports/page/html_cards.h"

#include <algorithm>

#include "reports/page/html_data.h"
#include "reports/page/viewer_data.h"
#include "reports/view/text.h"

namespace photonproof::reports::inline reports_page {
namespace {

using kainjow::mustache::data;
namespace fs = std::filesystem;

struct Role {
  const char* name;
  const char* alt;
  const char* title;
};
constexpr Role map_roles[] = {{"flip", "FLIP map", "FLIP"}, {"error", "relative error map", "relative error"}};

struct Embedded {
  EmbeddedPicture image;
  std::vector<EmbeddedPicture> maps;  ///< one for each of map_roles, empty when the image has none
};

/// All pictures, reduced to `side` at most; sets `side` to 0 if none had to be reduced.
std::vector<Embedded> embed_all(const std::vector<SceneImage>& images, const fs::path& folder, bool with_maps,
                                int& side, std::size_t& bytes) {
  std::vector<Embedded> all;
  bool any_reduced = false;
  bytes = 0;
  const auto embed = [&](const std::string& file) {
    const EmbeddedPicture picture = embed_thumbnail(folder, file, side);
    any_reduced = any_reduced || picture.reduced;
    bytes += picture.uri.size();
    return picture;
  };
  for (const SceneImage& image : images) {
    Embedded& embedded = all.emplace_back();
    embedded.image = image.problem.empty() ? embed(picture_file(image.pictures, "image"))
                                           : EmbeddedPicture{{}, 0, 0, image.problem, false};
    if (image.is_reference || !image.problem.empty() || !with_maps) continue;
    for (const Role& role : map_roles) embedded.maps.push_back(embed(picture_file(image.pictures, role.name)));
  }
  if (!any_reduced) side = 0;
  return all;
}

data card_data(const View& view, const SceneImage& image, const Embedded& embedded, const std::string& scene_id,
               std::size_t index) {
  data card = image.engine ? engine_data(view, *image.engine) : data();
  card.set("has_swatch", image.engine.has_value());
  card.set("title", printable(image.title));
  card.set("caption", printable(image.caption));
  card.set("has_scales", image.is_reference);  // its room below is used for heat maps by other cards
  set_picture(card, embedded.image, image.subject);
  card.set("picture_id", data(false));
  data maps(data::type::list);
  for (std::size_t i = 0; i < embedded.maps.size(); ++i) {
    const Role& role = map_roles[i];
    data map;
    set_picture(map, embedded.maps[i], std::string(role.alt) + " of " + image.subject);
    map.set("picture_id", map_id(scene_id, index, role.name));
    const auto score = image.scores.find(role.name);
    map.set("caption", score == image.scores.end() ? std::string(role.title) : printable(score->second));
    maps.push_back(map);
  }
  card.set("has_maps", maps.is_non_empty_list());
  card.set("maps", maps);
  return card;
}

}  // namespace

Gallery gallery(const View& view, const SceneView& scene, const std::vector<SceneImage>& images, const fs::path& folder,
                const std::string& scene_id, std::size_t allowance) {
  Gallery out;
  std::vector<Embedded> embedded;
  std::size_t whole = 0;  // bytes of all unreduced pictures
  int longest = 0;        // side of the largest
  constexpr int least_side = 32;
  for (const int side : {4096, 512, 384, 256, 192, 128, 96, 64, least_side}) {
    // Bytes are proportional to the area, so sizes that would take more than twice the allowance are not tried.
    const double part = static_cast<double>(side) / std::max(longest, 1);
    const bool too_large = static_cast<double>(whole) * part * part > 2.0 * static_cast<double>(allowance);
    if (whole > 0 && too_large && side > least_side) continue;
    out.longest_side = side;
    embedded = embed_all(images, folder, has_reference(scene), out.longest_side, out.bytes);
    if (out.bytes <= allowance) break;
    if (whole > 0) continue;
    whole = out.bytes;
    for (const Embedded& each : embedded) longest = std::max({longest, each.image.width, each.image.height});
  }
  out.cards = data(data::type::list);
  for (std::size_t i = 0; i < images.size(); ++i) {
    out.cards.push_back(card_data(view, images[i], embedded[i], scene_id, i));
  }
  return out;
}

}  // namespace photonproof::reports::inline reports_page
