// Textures that shapes hold as attributes, which Mitsuba 3 allows for shapes of every kind.
#pragma once

#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

/// Puts the textures that a shape holds by a name vertex_NAME or face_NAME in place of the mesh attributes of that name
/// in its BSDF. A shared BSDF of `scene` that shows one is copied into the shape. Members of groups count as shapes.
void put_textures_in_place_of_attributes(Element& scene);

}  // namespace photonproof::scene_xml
