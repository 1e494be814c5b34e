#include "scenes/dialect/hair_stand_in.h"

#include <cmath>
#include <optional>

#include "scenes/base/vec.h"

namespace photonproof::scene_xml {
namespace {

/// Absorption of the two pigments at a concentration of 1: d'Eon et al. 2011, "An energy-conserving hair reflectance
/// model", table 2, in RGB.
const RgbD kEumelanin{0.419, 0.697, 1.37}, kPheomelanin{0.187, 0.4, 1.05};

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

/// Reflectance of a volume of hair: Chiang et al. 2016, "A practical and controllable hair and fur model for production
/// path tracing", equation 9 solved for it. `roughness` is the azimuthal one.
double reflectance(double absorption, double roughness) {
  const double b = roughness;
  const double fit = 5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245))));
  return std::exp(-std::sqrt(absorption) * fit);
}

}  // namespace

void replace_hair(Element& bsdf, StandInNotes& notes) {
  Element left = bsdf;
  const auto along = take_number(left, "longitudinal_roughness", 0.3),
             around = take_number(left, "azimuthal_roughness", 0.3);
  const auto eumelanin = take_number(left, "eumelanin", 1.3), pheomelanin = take_number(left, "pheomelanin", 0.2);
  if (!along || !around || !eumelanin || !pheomelanin) return;
  RgbD absorption = kEumelanin * *eumelanin + kPheomelanin * *pheomelanin;
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
  std::string colour;
  for (const double a : {absorption.x, absorption.y, absorption.z})
    colour += (colour.empty() ? "" : " ") + format_number(reflectance(a * scale, *around));
  add_parameter(bsdf, "rgb", "base_color", colour);
  add_parameter(bsdf, "float", "roughness", format_number(std::min(*along, 1.0)));
}

}  // namespace photonproof::scene_xml
