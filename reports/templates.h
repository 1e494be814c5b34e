// The files of reports/templates/, compiled in (see embed_templates.cmake), so that the program needs no data folder.
#pragma once

#include <string_view>

namespace photonproof::reports::templates {

extern const std::string_view page, scene_section, picture_img, thumbnail_img, swatch_svg, style;

}  // namespace photonproof::reports::templates
