// Notes on parts of a scene too near, far, narrow or wide for the precision of numbers or for the traced paths.
#pragma once

#include <vector>

#include "renderer/limits/notes.h"

namespace photonproof::inline renderer_limits {

/// Cameras and media first, then places, faces and lights.
void add_precision_notes(const SceneDescription& description, const SceneParts& scene, Notes& notes);

/// Notes on small lights just above a surface, whose brightest spot this number of camera paths may miss. For
/// integrators that find lights only by camera paths.
std::vector<SceneNote> notes_on_missed_spots(const SceneDescription& description, const SceneParts& scene,
                                             double camera_paths);

/// The place of each of the scene's lights: those of the shapes, one per surface, and then the emitters.
std::vector<SourceLoc> places_of_lights(const SceneDescription& description);
/// The number of surfaces that a shape becomes, each a light where the shape emits.
std::size_t surfaces_of(const ShapeDescription& shape);

}  // namespace photonproof::inline renderer_limits
