#include "reference/engines/engine_run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scenes/base/input_error.h"

namespace photonproof::inline reference_engines {

void report_failure(const EngineProgram& engine, const ProcessOutcome& outcome, const std::string& said) {
  using End = ProcessOutcome::End;
  const std::string& name = engine.name;
  if (outcome.end == End::not_started)
    throw InputError(engine.program,
                     name + " cannot be run (" + outcome.cause + "); on Debian: apt install " + engine.package);
  if (outcome.end == End::interrupted) throw EngineFailure(EngineFailure::Kind::interrupted, name + " was interrupted");
  if (outcome.end == End::timed_out || outcome.end == End::out_of_memory)
    throw EngineFailure(EngineFailure::Kind::limit, name + " was " + outcome.sentence());
  throw EngineFailure(EngineFailure::Kind::failed, name + " " + outcome.sentence() + (said.empty() ? "" : ": " + said));
}

std::string command_line(const std::vector<std::string>& argv) {
  std::string line;
  for (const std::string& word : argv) line += (line.empty() ? "" : " ") + word;
  return line;
}

Image kept_part(const FilmDescription& film, const Image& image) {
  const FilmDescription::Crop crop = film.window();
  Image part(crop.width, crop.height);
  for (int y = 0; y < crop.height; ++y) std::copy_n(image.pixel(crop.x, crop.y + y), 3 * crop.width, part.pixel(0, y));
  return part;
}

std::optional<ImagePlace> kept_place(const FilmDescription& film) {
  if (!film.crop) return std::nullopt;
  return ImagePlace{film.crop->x, film.crop->y, film.width, film.height};
}

std::vector<std::string> find_non_finite(const Image& image, const std::string& why) {
  std::size_t bad = 0, first = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    if (std::isfinite(image.rgb[i])) continue;
    if (bad++ == 0) first = i / 3;
  }
  if (bad == 0) return {};
  const auto width = static_cast<std::size_t>(image.width);
  return {std::to_string(bad) + " values are not finite, the first in pixel (" + std::to_string(first % width) + ", " +
          std::to_string(first / width) + "): " + why};
}

}  // namespace photonproof::inline reference_engines
