// Writes a SceneDescription as scene XML; parse -> write -> parse is the identity (except for source positions).
#pragma once

#include <string>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_xml {

/// The whole scene in one file. A BSDF with an id stands in the scene, one without in each shape that uses it. The
/// table of BSDFs reads back the same when it has the parser's order: those with an id first, then one for each shape,
/// in the shapes' order. Meshes stay in their files, whose names are kept: the text belongs in the folder of the scene
/// it was read from.
std::string write_scene(const SceneDescription& scene);

}  // namespace photonproof::inline scenes_xml
