// Which channels of an image file are its colour. Renderers write several pictures into one EXR: layers, named before
// the last dot of a channel's name ("ViewLayer.Combined.R"), and parts, which have names of their own.
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
  std::vector<std::string> channels;  ///< red, green and blue, or a single grey one, as the part names them
  std::string layer;                  ///< what is read, for people; empty for the only R, G, B of a file
};

/// The plain R, G, B of a file of one part; else its only layer with R, G, B; else the only one that is called
/// Combined, beauty, rgba or rgb; else grey from its only Y or its only channel. `layer` chooses instead, by the name
/// of a layer or a channel; a file that has nothing but one plain colour stays as it is. Throws InputError, naming the
/// file and its layers, when nothing or more than one thing is meant.
ColourChoice choose_colour(const std::string& path, const std::vector<ImagePart>& parts, const std::string& layer);

}  // namespace photonproof::inline scenes_images
