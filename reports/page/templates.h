// The files of reports/templates/, compiled in (see embed_templates.cmake), so that the program needs no data folder.
#pragma once

#include <string_view>

namespace photonproof::reports::templates {

extern const std::string_view page, scene_section, cell_details, picture_img, thumbnail_img, swatch_svg, verdict_chip,
    gates_table, plain_table, race_table, viewer_page, style;
/// All of *.js as one function, and its SHA-256 in hexadecimal.
extern const std::string_view script, script_sha256;

}  // namespace photonproof::reports::templates
