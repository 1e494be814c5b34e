// Where Mitsuba 3.9.1 departs from its documents or from a closed form, this renderer is right. These functions change
// a scene so that its image is Mitsuba's anyway, for those who must match it. Every change has a note. The table of
// departures, with a proof for each, is in docs/formats/scene.md.
#pragma once

#include <vector>

#include "scenes/description/description.h"
#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

/// Replaces each <rotate> whose axis has not the length 1 by the matrix that Mitsuba makes of it. An axis (0, 0, 0)
/// stays: reading it is an error.
std::vector<SceneNote> rotate_as_mitsuba(const Sources& sources, Element& root);

/// Follows the other departures, and adds their notes. Those that depend on the integrator follow later, from
/// SceneDescription::as_mitsuba.
void follow_mitsuba(SceneDescription& scene);

}  // namespace photonproof::scene_xml
