// Checks of a request that need neither the plan nor the compiled scene.
#pragma once

#include <optional>

#include "renderer/core/parallel.h"
#include "renderer/passes/render_job.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_api {

/// The part of the image that is rendered: `asked`, or the film's own crop. Throws InputError at "--crop" when it is
/// not inside the image.
Tile film_window(const FilmDescription& film, const std::optional<FilmDescription::Crop>& asked);

/// Memory of a render beside its film.
struct BesideFilm {
  bool checkpoints = false;  ///< copies of the film
  bool denoiser = false;     ///< guides, and the denoiser's own memory
};

/// Throws InputError at the sensor when the film and what is beside it take more memory than is free.
void check_memory(const SceneDescription& description, const Tile& window, const BesideFilm& beside);

/// Throws InputError at "--denoise" where the image is no light that a denoiser knows.
void check_denoise(const RenderJob& job);

}  // namespace photonproof::inline renderer_api
