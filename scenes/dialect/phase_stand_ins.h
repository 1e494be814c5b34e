// Phase functions that this renderer has not, by the nearest one that it has.
#pragma once

#include "scenes/dialect/stand_in_notes.h"

namespace photonproof::scene_xml {

/// A phase function given by a table becomes Henyey and Greenstein's of the same mean cosine, with a note.
void replace_phase(Element& phase, StandInNotes& notes);

}  // namespace photonproof::scene_xml
