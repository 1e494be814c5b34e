// Writes a SceneDescription as scene XML; parse -> write -> parse is the identity (but for source positions).
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_xml {

/// The whole scene in one file. A BSDF with an id stands in the scene, one without in each shape that uses it, so the
/// table of BSDFs reads back the same when it is as the parser makes it: those with an id first, each other one used
/// by exactly one shape, in the shapes' order. Meshes stay in their files, whose names are kept: the text belongs in
/// the folder of the scene it was read from.
std::string write_scene(const SceneDescription& scene);

}  // namespace photonproof::inline scenes_xml
