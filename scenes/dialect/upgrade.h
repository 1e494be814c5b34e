// Files of versions before 2.0, which are Mitsuba 0.6's, with the names of today.
#pragma once

#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

/// Renames as Mitsuba 2 and 3 do when they load such a file: camelCase becomes snake_case, lookAt lookat, and a diffuse
/// BSDF's reflectance gets its new name. A texture's uoffset, voffset, uscale and vscale become a transform. Here uv is
/// scaled before it is moved, as version 0.6 does. Mitsuba 3 moves first, and drops an offset along one axis alone.
void upgrade_names(Element& root);

}  // namespace photonproof::scene_xml
