// Integrators of other renderers and versions.
#pragma once

#include "scenes/dialect/stand_in_notes.h"

namespace photonproof::scene_xml {

/// The integrator of ours that is nearest to an unknown one. One that nests another gives way to that one. A name that
/// is nearly one of ours stays, and the reader refuses it.
void replace_integrator(Element& integrator, bool scene_has_media, StandInNotes& notes);

}  // namespace photonproof::scene_xml
