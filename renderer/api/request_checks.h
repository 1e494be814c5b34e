// Checks of a request that need neither the plan nor the compiled scene.
#pragma once

#include <optional>

#include "renderer/core/parallel.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_api {

/// The part of the image that is rendered: `asked`, or the film's own crop. Throws InputError at "--crop" when it is
/// not inside the image.
Tile film_window(const FilmDescription& film, const std::optional<FilmDescription::Crop>& asked);

/// Throws InputError at the sensor when the film alone takes more memory than is free. `checkpoints`: the render keeps
/// copies of the film for them.
void check_memory(const SceneDescription& description, const Tile& window, bool checkpoints);

}  // namespace photonproof::inline renderer_api
