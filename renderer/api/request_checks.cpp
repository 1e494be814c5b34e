#include "renderer/api/request_checks.h"

#include <algorithm>
#include <string>

#include "renderer/core/available_memory.h"
#include "renderer/denoising/denoiser.h"
#include "renderer/sensor/film.h"
#include "scenes/base/input_error.h"
#include "scenes/base/size_text.h"

namespace photonproof::inline renderer_api {

Tile film_window(const FilmDescription& film, const std::optional<FilmDescription::Crop>& asked) {
  const FilmDescription::Crop crop = asked.value_or(film.window());
  const bool inside = crop.x >= 0 && crop.y >= 0 && crop.width > 0 && crop.height > 0 &&
                      crop.width <= film.width - crop.x && crop.height <= film.height - crop.y;
  const auto words = [](int a, int b) { return std::to_string(a) + " " + std::to_string(b); };
  if (!inside)
    throw InputError("--crop", words(crop.x, crop.y) + " " + words(crop.width, crop.height) +
                                   " is no part of the image of " + size_text(film.width, film.height) + " pixels");
  return {crop.x, crop.y, crop.x + crop.width, crop.y + crop.height};
}

void check_memory(const SceneDescription& description, const Tile& window, const BesideFilm& beside) {
  const std::optional<std::uint64_t> available = available_memory();
  // A checkpoint is a copy of the film. At the end, mean and variance stand beside the film, and once more as the rows
  // of a file.
  constexpr std::size_t written = 2 * 6 * sizeof(float);
  const std::size_t parts = has_negative_lobes(description.sensor.film.filter.kind) ? 2 : 1;
  const std::size_t of_film = parts * Film::bytes_a_pixel();
  const std::size_t copies = beside.checkpoints ? std::max(of_film, written) : written;
  const std::uint64_t pixels = static_cast<std::uint64_t>(window.width()) * static_cast<std::uint64_t>(window.height());
  const std::uint64_t bytes =
      std::uint64_t{of_film + copies} * pixels + (beside.denoiser ? Denoiser::bytes(pixels) : 0);
  if (!available || bytes <= *available) return;
  const auto megabytes = [](std::uint64_t n) { return std::to_string(n >> 20) + " MB"; };
  throw InputError(description.where(description.sensor.loc),
                   "an image of " + size_text(window.width(), window.height()) + " pixels takes " + megabytes(bytes) +
                       " of memory, but only " + megabytes(*available) +
                       " are free: render it smaller or, by --crop, in parts");
}

void check_denoise(const RenderJob& job) {
  if (job.view != Aov::whole)
    throw InputError("--denoise", "is for the whole image, not for the view '" + std::string(aov_row(job.view).name) +
                                      "', which shows the method");
}

}  // namespace photonproof::inline renderer_api
