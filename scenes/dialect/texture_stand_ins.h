// Parameters of textures in Mitsuba 0.6.
#pragma once

#include "scenes/dialect/stand_in_notes.h"

namespace photonproof::scene_xml {

/// A bitmap's gamma, wrapModeU and wrapModeV, channel, and the values of wrapMode and filterType that Mitsuba 3 has
/// not.
void replace_texture(Element& texture, StandInNotes& notes);

}  // namespace photonproof::scene_xml
