#include "reports/page/viewer_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "reports/page/page_parts.h"
#include "reports/page/pixel_data.h"
#include "reports/page/templates.h"
#include "reports/view/engine_style.h"
#include "reports/view/text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_page {
using namespace reports;

namespace {

using nlohmann::json;

constexpr std::size_t most_bytes = 24'000'000;

json viewer_of(const ViewerPage& page) {
  std::vector<LoadedImage> loaded;
  loaded.reserve(page.images.size());
  for (const ViewedImage& viewed : page.images) loaded.push_back({viewed.image});
  const PixelDataSet set = pixel_data(loaded, most_bytes);
  json images = json::array(), notes = json::array();
  std::size_t others = 0;
  for (std::size_t i = 0; i < page.images.size(); ++i) {
    json image = {{"title", printable(page.images[i].title)},
                  {"caption", printable(page.images[i].caption)},
                  {"isReference", page.reference == i},
                  {"pixels", set.images[i].base64},
                  {"maps", json::object()}};
    if (page.reference != i) {
      image["color"] = engine_color(others);
      image["shape"] = engine_style(others).svg_shape;
      ++others;
    }
    images.push_back(std::move(image));
  }
  if (set.reduced_by > 1)
    notes.push_back(
        fmt::format("To keep the page small, {0} × {0} pixels are averaged into one here.", set.reduced_by));
  return {{"name", printable(page.title)},
          {"exposure", page.exposure},
          {"width", page.images.front().image.width},
          {"height", page.images.front().image.height},
          {"reducedBy", set.reduced_by},
          {"notes", std::move(notes)},
          {"images", std::move(images)},
          {"tiles", json::array()}};
}

}  // namespace

void write_viewer_page(const ViewerPage& page, const std::filesystem::path& out) {
  kainjow::mustache::data values;
  set_style_and_script(values, std::string(templates::style), templates::script, templates::script_sha256);
  values.set("title", printable(page.title));
  values.set("viewer_json", json_in_html(viewer_of(page).dump(-1, ' ', false, json::error_handler_t::replace)));
  write_file_atomically(out, rendered_page(templates::viewer_page, values));
}

}  // namespace photonproof::inline reports_page
