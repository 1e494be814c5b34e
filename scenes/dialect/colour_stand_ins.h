// Colours as Mitsuba 0.6 and volumes of one colour are written.
#pragma once

#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

/// <srgb> becomes <rgb>, <blackbody> a <spectrum> of that type, and a <spectrum> of three numbers <rgb>. The attribute
/// `intent` goes, as the place of a colour says whether it is reflected or emitted. A
/// volume `constvolume` becomes its colour.
void replace_colour(Element& colour);

/// Refs to the scene's colours become these colours.
void put_colours_in_place_of_refs(Element& scene);

}  // namespace photonproof::scene_xml
