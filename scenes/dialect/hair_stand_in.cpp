#include "scenes/dialect/hair_stand_in.h"

#include <algorithm>
#include <optional>

#include "scenes/base/vec.h"
#include "scenes/curves/hair_colour.h"

namespace photonproof::scene_xml {
namespace {

std::optional<RgbD> numbers_of(const Element& parameter) {
  std::vector<double> values;
  const std::string text = value_of(parameter, "value");
  for (const std::string_view word : split_list(text)) {
    const auto parsed = parse_number(word);
    if (!parsed.value || *parsed.value < 0) return std::nullopt;
    values.push_back(*parsed.value);
  }
  if (values.size() == 1) return RgbD(values[0]);
  return values.size() == 3 ? std::optional(RgbD(values[0], values[1], values[2])) : std::nullopt;
}

/// The number of a parameter, which is taken away; `fallback` where it is not given.
std::optional<double> take_number(Element& bsdf, const char* name, double fallback) {
  const Element given = take_parameter(bsdf, name);
  if (given.tag.empty()) return fallback;
  const auto number = numbers_of(given);
  return number ? std::optional(number->x) : std::nullopt;
}

}  // namespace

void replace_hair(Element& bsdf, StandInNotes& notes) {
  Element left = bsdf;
  const auto along = take_number(left, "longitudinal_roughness", 0.3),
             around = take_number(left, "azimuthal_roughness", 0.3);
  const auto eumelanin = take_number(left, "eumelanin", 1.3), pheomelanin = take_number(left, "pheomelanin", 0.2);
  if (!along || !around || !eumelanin || !pheomelanin) return;
  RgbD absorption = absorption_of_pigments(*eumelanin, *pheomelanin);
  if (const Element given = take_parameter(left, "sigma_a"); !given.tag.empty()) {
    const auto sigma_a = numbers_of(given);
    if (!sigma_a) return;
    absorption = *sigma_a;
  }
  const double scale = take_number(left, "scale", 1).value_or(1);
  take_parameter(left, "scale_tilt");
  for (const char* name : {"int_ior", "ext_ior"}) take_parameter(left, name);
  if (!left.children.empty()) return;
  notes.add_stand_in(bsdf, "principled", "it has the colour of a full head of hair, without light through hairs");
  bsdf.children.clear();
  set_attribute(bsdf, "type", "principled");
  const RgbD colour = colour_of_hair(absorption * scale, *around);
  add_parameter(bsdf, "rgb", "base_color",
                format_number(colour.x) + " " + format_number(colour.y) + " " + format_number(colour.z));
  add_parameter(bsdf, "float", "roughness", format_number(std::min(*along, 1.0)));
}

}  // namespace photonproof::scene_xml
