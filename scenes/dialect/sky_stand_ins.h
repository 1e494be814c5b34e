// The sun and the sky of Mitsuba 0.6, where +y is up.
#pragma once

#include "scenes/dialect/stand_in_notes.h"

namespace photonproof::scene_xml {

/// A sun or a sky becomes a `sunsky` without the other, and any of the three gets +y as its up. Without a note where
/// `emitter` is none of them.
void replace_sky(Element& emitter, StandInNotes& notes);

/// The `sunsky` of a file of version 0.6 under a name by which replace_sky knows it.
inline constexpr const char* sunsky_of_old = "sunsky of Mitsuba 0.6";

}  // namespace photonproof::scene_xml
