// The pictures of the page's first screen: one scene's images, its reference and their FLIP maps.
#pragma once

#include <filesystem>
#include <kainjow/mustache.hpp>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_page {

/// Sets {has_strip, strip: {href, scene, pictures}}. The scene is that of the worst failing gate, else of the clearest
/// race, else the first with a reference. A race is clear where errors in the same time differ tenfold. Its images are
/// those of the first two engines whose times lie nearest to each other. Without a picture there is no strip.
void set_strip(kainjow::mustache::data& page, const View& view, const std::filesystem::path& folder);

}  // namespace photonproof::reports::inline reports_page
