#include "scenes/dialect/colour_stand_ins.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>

#include "scenes/base/srgb.h"
#include "scenes/base/text_numbers.h"
#include "scenes/dialect/element_edit.h"

namespace photonproof::scene_xml {
namespace {

constexpr std::array<std::string_view, 7> kSpectra = {"blackbody", "d65",  "irregular", "rawconstant",
                                                      "regular",   "srgb", "uniform"};

/// The linear values of encoded ones, as text; the text itself where it is none of 1 or 3 numbers.
std::string decoded(const std::string& text) {
  const auto words = split_list(text);
  if (words.size() != 1 && words.size() != 3) return text;
  std::string result;
  for (const std::string_view word : words) {
    const auto parsed = parse_number(word);
    if (!parsed.value) return text;
    result += (result.empty() ? "" : " ") + format_number(decode_srgb(*parsed.value));
  }
  return result;
}

void move_to_parameter(Element& spectrum, const char* attribute) {
  std::string value = value_of(spectrum, attribute);
  if (value.empty()) return;
  if (value.back() == 'K' || value.back() == 'k') value.pop_back();
  std::erase_if(spectrum.attributes, [&](const Attribute& a) { return a.name == attribute; });
  add_parameter(spectrum, "float", attribute, value);
}

/// A parameter that a constant volume stands for, by the volume's name. A volume that is placed is left as it is.
void replace_constant_volume(Element& volume) {
  if (volume.tag != "volume" || value_of(volume, "type") != "constvolume" || !volume.find("name")) return;
  if (volume.children.size() != 1 || value_of(volume.children.front(), "name") != "value") return;
  Element value = std::move(volume.children.front());
  set_attribute(value, "name", value_of(volume, "name"));
  volume = std::move(value);
}

/// Whether a plugin's values do not vary over a surface. Mitsuba writes such plugins as spectra or as textures.
bool is_spectrum(const std::string& type) { return std::ranges::find(kSpectra, type) != kSpectra.end(); }

bool is_colour(const Element& element) {
  return element.tag == "rgb" || element.tag == "spectrum" ||
         (element.tag == "texture" && is_spectrum(value_of(element, "type")));
}

void put_in_place(Element& object, const std::map<std::string, Element>& known) {
  for (Element& child : object.children) {
    const auto colour = child.tag == "ref" ? known.find(value_of(child, "id")) : known.end();
    if (colour == known.end()) {
      put_in_place(child, known);
      continue;
    }
    const std::string name = value_of(child, "name");
    child = colour->second;
    std::erase_if(child.attributes, [](const Attribute& a) { return a.name == "id"; });
    set_attribute(child, "name", name);
  }
}

/// The number or colour that it holds.
void replace_raw_constant(Element& spectrum) {
  const Element* value = parameter_of(spectrum, "value");
  if (value == nullptr) return;
  const std::string name = value_of(spectrum, "name"), numbers = value_of(*value, "value");
  spectrum = new_element(spectrum, "rgb");
  if (!name.empty()) set_attribute(spectrum, "name", name);
  set_attribute(spectrum, "value", numbers);
}

/// The white of d65, times its scale, colours a texture.
void replace_coloured_d65(Element& spectrum) {
  if (value_of(spectrum, "type") != "d65") return;
  const auto texture = std::ranges::find_if(
      spectrum.children, [](const Element& c) { return c.tag == "texture" && !is_spectrum(value_of(c, "type")); });
  if (texture == spectrum.children.end()) return;
  spectrum.tag = "texture";
  set_attribute(spectrum, "type", "scale");
  std::erase_if(texture->attributes, [](const Attribute& a) { return a.name == "name"; });
}

}  // namespace

void put_colours_in_place_of_refs(Element& scene) {
  std::map<std::string, Element> known;
  std::erase_if(scene.children, [&](const Element& child) {
    if (!is_colour(child) || !child.find("id")) return false;
    return known.emplace(value_of(child, "id"), child).second;
  });
  if (!known.empty()) put_in_place(scene, known);
}

void replace_colour(Element& colour) {
  replace_constant_volume(colour);
  if (colour.tag == "texture" && is_spectrum(value_of(colour, "type"))) colour.tag = "spectrum";
  if (colour.tag == "spectrum" && value_of(colour, "type") == "rawconstant") replace_raw_constant(colour);
  if (colour.tag == "spectrum") replace_coloured_d65(colour);
  if (colour.tag == "srgb") {
    colour.tag = "rgb";
    if (colour.find("value")) set_attribute(colour, "value", decoded(value_of(colour, "value")));
  }
  if (colour.tag == "blackbody") {
    colour.tag = "spectrum";
    set_attribute(colour, "type", "blackbody");
    move_to_parameter(colour, "temperature");
    move_to_parameter(colour, "scale");
  }
  if (colour.tag == "rgb" || colour.tag == "spectrum")
    std::erase_if(colour.attributes, [](const Attribute& a) { return a.name == "intent"; });
  const std::string value = value_of(colour, "value");
  if (colour.tag == "spectrum" && value.find(':') == std::string::npos && split_list(value).size() == 3)
    colour.tag = "rgb";
  if (colour.tag == "spectrum" && !value.empty() && value[0] == '#') colour.tag = "rgb";
}

}  // namespace photonproof::scene_xml
