// The part of a film that is rendered, compared and shown: its crop, in files that store it and in files that store
// more.
#pragma once

#include <optional>
#include <string>

#include "scenes/description/view_description.h"
#include "scenes/images/image.h"

namespace photonproof::inline scenes_description {

struct FilmPart {
  ImagePlace place;           ///< its upper left pixel, and the size of the whole film
  int width = 0, height = 0;  ///< pixels of the part
  /// "24x16 from (12, 8) of 48x32"
  std::string text() const;
};

/// The crop of a film rendered at that size; empty where it is the whole film.
std::optional<FilmPart> crop_of(FilmDescription film, int width, int height);
/// The part of the film that a rendering is; empty where it is the whole film.
std::optional<FilmPart> crop_of(const Rendering& rendering);
FilmPart whole_film(int width, int height);

/// That part alone, cut from a rendering of the film or of another part of it; black where that has no pixels. A
/// rendering of the part's size that names no film is the part. Empty where the rendering is of another size.
std::optional<Rendering> part_of(Rendering rendering, const FilmPart& part);
/// Whether the rendering is that part already, place and size.
bool is_part(const Rendering& rendering, const FilmPart& part);
/// Whether part_of has a result for a file whose `width` x `height` pixels are at `place`.
bool has_part(const std::optional<ImagePlace>& place, int width, int height, const FilmPart& part);

/// The pixels that the file stores: a crop without the black around it. Throws InputError as read_rendering does.
Rendering read_stored(const std::string& path);

}  // namespace photonproof::inline scenes_description
