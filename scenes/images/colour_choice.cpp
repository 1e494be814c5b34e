#include "scenes/images/colour_choice.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "scenes/base/input_error.h"

namespace photonproof::inline scenes_images {
namespace {

constexpr std::array<const char*, 4> names_of_the_whole{"combined", "beauty", "rgba", "rgb"};

/// The part of a channel's name up to and including its last dot.
std::string prefix_of(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? "" : channel.substr(0, dot + 1);
}

bool has_channel(const ImagePart& part, const std::string& channel) {
  return std::ranges::find(part.channels, channel) != part.channels.end();
}

/// A layer's name in the file: its part's, where there are several, and that of its channels.
std::string full_name(const std::vector<ImagePart>& parts, std::size_t part, const std::string& name) {
  const std::string& own = parts[part].name;
  if (parts.size() == 1 || own.empty() || name == own || name.starts_with(own + ".")) return name;
  return name.empty() ? own : own + "." + name;
}

std::vector<ColourChoice> colour_layers(const std::vector<ImagePart>& parts) {
  std::vector<ColourChoice> layers;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const std::string& red : parts[p].channels) {
      const std::string prefix = prefix_of(red);
      if (red != prefix + "R" || prefix == "variance.") continue;
      if (!has_channel(parts[p], prefix + "G") || !has_channel(parts[p], prefix + "B")) continue;
      const std::string name = prefix.empty() ? "" : prefix.substr(0, prefix.size() - 1);
      layers.push_back({p, {prefix + "R", prefix + "G", prefix + "B"}, full_name(parts, p, name)});
    }
  return layers;
}

/// Grey layers: luminance, unless it belongs to an image whose colour lies beside it.
std::vector<ColourChoice> grey_layers(const std::vector<ImagePart>& parts) {
  std::vector<ColourChoice> layers;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::vector<std::string>& channels = parts[p].channels;
    const bool is_only = parts.size() == 1 && channels.size() == 1 && channels[0] != "A" && channels[0] != "Z";
    for (const std::string& channel : channels)
      if (is_only || (channel == prefix_of(channel) + "Y" && !has_channel(parts[p], prefix_of(channel) + "RY")))
        layers.push_back({p, {channel}, "grey from channel " + full_name(parts, p, channel)});
  }
  return layers;
}

bool is_the_whole(const ColourChoice& choice) {
  std::string last = choice.layer.substr(prefix_of(choice.layer).size());
  std::ranges::transform(last, last.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(names_of_the_whole, last) != names_of_the_whole.end();
}

std::string names_of(const std::vector<ColourChoice>& layers) {
  std::string names;
  for (const ColourChoice& layer : layers)
    names += (names.empty() ? "" : ", ") + (layer.layer.empty() ? "R, G, B without a name" : layer.layer);
  return names;
}

ColourChoice asked_for(const std::string& path, const std::vector<ImagePart>& parts,
                       const std::vector<ColourChoice>& layers, const std::string& layer) {
  std::vector<ColourChoice> found;
  for (const ColourChoice& choice : layers)
    if (choice.layer == layer) return choice;
  for (const ColourChoice& choice : layers)
    if (choice.layer.ends_with("." + layer)) found.push_back(choice);
  for (std::size_t p = 0; p < parts.size() && found.empty(); ++p)
    for (const std::string& channel : parts[p].channels)
      if (channel == layer || full_name(parts, p, channel) == layer)
        found.push_back({p, {channel}, "grey from channel " + full_name(parts, p, channel)});
  if (found.size() == 1) return found[0];
  throw InputError(path, (found.empty() ? "has no layer '" : "has several layers '") + layer + "': it has " +
                             (layers.empty() ? "none with R, G, B" : names_of(layers)));
}

}  // namespace

ColourChoice choose_colour(const std::string& path, const std::vector<ImagePart>& parts, const std::string& layer) {
  const std::vector<ColourChoice> layers = colour_layers(parts), greys = grey_layers(parts);
  const bool is_plain = parts.size() == 1 && layers.size() == 1 && layers[0].layer.empty();
  if (!layer.empty() && !is_plain) return asked_for(path, parts, layers, layer);
  if (layers.size() == 1) return layers[0];
  if (parts.size() == 1)
    for (const ColourChoice& choice : layers)
      if (choice.layer.empty()) return choice;
  if (std::ranges::count_if(layers, is_the_whole) == 1) return *std::ranges::find_if(layers, is_the_whole);
  if (layers.empty() && greys.size() == 1) return greys[0];
  const std::vector<ColourChoice>& all = layers.empty() ? greys : layers;
  if (all.empty()) throw InputError(path, "image has no colour: expected channels R, G, B or a single grey one");
  throw InputError(path, "holds several images, and none of them alone is called Combined, beauty or rgba: " +
                             names_of(all) + "; compare --layer NAME takes one");
}

}  // namespace photonproof::inline scenes_images
