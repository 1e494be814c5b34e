// The channels of an image file that are its colour. Renderers write several images into one EXR: layers, named before
// the last dot of a channel's name ("ViewLayer.Combined.R"), and parts, which have their own names.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace photonproof::inline scenes_images {

/// A part of a file, with the channels that can be read as numbers for every pixel.
struct ImagePart {
  std::string name;
  std::vector<std::string> channels;
};

struct ColourChoice {
  std::size_t part = 0;
  std::vector<std::string> channels;  ///< Red, green and blue, or a single grey one, as the part names them.
  std::string layer;                  ///< The layer that is read, for people; empty for the only R, G, B of a file.
};

/// The first of these that a file has: the plain R, G, B of a file of one part; its only layer with R, G, B. Then the
/// only one called Combined, beauty, rgba or rgb; grey from its only Y or its only channel. `layer` chooses instead, by
/// the name of a layer or a channel, except in a file that has only one plain colour. Throws InputError, naming the
/// file and its layers, when no choice or more than one fits.
ColourChoice choose_colour(const std::string& path, const std::vector<ImagePart>& parts, const std::string& layer);

}  // namespace photonproof::inline scenes_images
