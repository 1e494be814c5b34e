#include "scenes/description/film_part.h"

#include <algorithm>
#include <utility>

#include "scenes/base/size_text.h"

namespace photonproof::inline scenes_description {
namespace {

Image cut(const Image& whole, const FilmPart& part) {
  Image out(part.width, part.height);
  for (int y = 0; y < part.height; ++y)
    std::copy_n(whole.pixel(part.place.x, part.place.y + y), 3 * part.width, out.pixel(0, y));
  return out;
}

bool is_whole(const FilmPart& part) { return part.width == part.place.width && part.height == part.place.height; }

std::optional<ImagePlace> stored_place(const FilmPart& part) {
  return is_whole(part) ? std::nullopt : std::optional(part.place);
}

}  // namespace

std::string FilmPart::text() const {
  return size_text(width, height) + " from (" + std::to_string(place.x) + ", " + std::to_string(place.y) + ") of " +
         size_text(place.width, place.height);
}

std::optional<FilmPart> crop_of(FilmDescription film, int width, int height) {
  film.resize(width, height);
  const FilmDescription::Crop window = film.window();
  const FilmPart part{{window.x, window.y, width, height}, window.width, window.height};
  return is_whole(part) ? std::nullopt : std::optional(part);
}

std::optional<FilmPart> crop_of(const Rendering& rendering) {
  if (!rendering.place) return std::nullopt;
  return FilmPart{*rendering.place, rendering.mean.width, rendering.mean.height};
}

FilmPart whole_film(int width, int height) { return {{0, 0, width, height}, width, height}; }

std::optional<Rendering> part_of(Rendering rendering, const FilmPart& part) {
  const Image& stored = rendering.mean;
  if (!has_part(rendering.place, stored.width, stored.height, part)) return std::nullopt;
  if (is_part(rendering, part)) return rendering;
  if (!rendering.place && stored.width == part.width && stored.height == part.height) {
    rendering.place = stored_place(part);
    return rendering;
  }
  const Rendering whole = displayed(rendering);
  Rendering out{cut(whole.mean, part), {}, whole.metadata};
  if (whole.variance) out.variance = cut(*whole.variance, part);
  out.place = stored_place(part);
  return out;
}

bool is_part(const Rendering& rendering, const FilmPart& part) {
  return rendering.place == stored_place(part) && rendering.mean.width == part.width &&
         rendering.mean.height == part.height;
}

bool has_part(const std::optional<ImagePlace>& place, int width, int height, const FilmPart& part) {
  const int film_width = place ? place->width : width, film_height = place ? place->height : height;
  if (film_width == part.place.width && film_height == part.place.height) return true;
  return !place && width == part.width && height == part.height;
}

Rendering read_stored(const std::string& path) { return read_rendering(path, "", ImageWindow::stored); }

}  // namespace photonproof::inline scenes_description
