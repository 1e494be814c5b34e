// BSDFs of Mitsuba 0.6.
#pragma once

#include "scenes/dialect/stand_in_notes.h"

namespace photonproof::scene_xml {

/// mixturebsdf, coating, roughcoating, ward, roughdiffuse, and the microfacet distributions of Ashikhmin and of Phong.
/// Others stay as they are.
void replace_bsdf(Element& bsdf, StandInNotes& notes);

}  // namespace photonproof::scene_xml
