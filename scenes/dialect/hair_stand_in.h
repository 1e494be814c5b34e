// Hair, by the principled BSDF of the colour that a full head of it has.
#pragma once

#include "scenes/dialect/stand_in_notes.h"

namespace photonproof::scene_xml {

/// A `hair` BSDF of Mitsuba 3 becomes `principled`, with a note. One whose absorption is no constant stays as it is,
/// for the reader to refuse.
void replace_hair(Element& bsdf, StandInNotes& notes);

}  // namespace photonproof::scene_xml
