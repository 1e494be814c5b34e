#include "reports/page/viewer_page.h"

#include <utility>

#include "reports/page/page_parts.h"
#include "reports/page/templates.h"
#include "reports/page/viewer_data.h"
#include "reports/view/text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_page {
using namespace reports;

namespace {

constexpr std::size_t most_bytes = 24'000'000;

std::string json_of(ViewerPage&& page) {
  std::vector<LoadedImage> loaded;
  std::vector<SceneImage> images;
  std::size_t others = 0;
  for (std::size_t i = 0; i < page.images.size(); ++i) {
    ViewedImage& viewed = page.images[i];
    loaded.push_back({std::move(viewed.image)});
    SceneImage& image = images.emplace_back();
    image.title = viewed.title;
    image.caption = viewed.caption;
    image.is_reference = page.reference == i;
    if (!image.is_reference) image.engine = others++;  // for its colour and marker
  }
  return viewer_json(page.title, page.exposure, images, pixel_data(loaded, most_bytes), "view", {});
}

}  // namespace

void write_viewer_page(ViewerPage page, const std::filesystem::path& out) {
  kainjow::mustache::data values;
  set_style_and_script(values, std::string(templates::style), templates::script, templates::script_sha256);
  values.set("title", printable(page.title));
  values.set("viewer_json", json_of(std::move(page)));
  write_file_atomically(out, rendered_page(templates::viewer_page, values));
}

}  // namespace photonproof::inline reports_page
