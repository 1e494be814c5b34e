#include "scenes/dialect/texture_stand_ins.h"

namespace photonproof::scene_xml {
namespace {

/// 1 is linear; -1 and 2.2 are sRGB, the default.
void replace_gamma(Element& bitmap, StandInNotes& notes) {
  const Element gamma = take_parameter(bitmap, "gamma");
  if (gamma.tag.empty()) return;
  const auto given = parse_number(value_of(gamma, "value"));
  if (given.value == 1.0 && !parameter_of(bitmap, "raw")) add_parameter(bitmap, "boolean", "raw", "true");
  if (given.value != 1.0 && given.value != -1.0 && given.value != 2.2)
    notes.add(gamma, "gamma " + value_of(gamma, "value") + " is read as sRGB");
}

void replace_wrap_mode(Element& bitmap, StandInNotes& notes) {
  const Element u = take_parameter(bitmap, "wrap_mode_u"), v = take_parameter(bitmap, "wrap_mode_v");
  if (value_of(u, "value") != value_of(v, "value")) notes.add(bitmap, "the texture wraps alike along u and v");
  if (const Element& given = u.tag.empty() ? v : u; !given.tag.empty() && !parameter_of(bitmap, "wrap_mode"))
    add_parameter(bitmap, "string", "wrap_mode", value_of(given, "value"));
  Element* mode = parameter_of(bitmap, "wrap_mode");
  const std::string name = mode ? value_of(*mode, "value") : "";
  if (name != "zero" && name != "one") return;
  notes.add(*mode, "wrap_mode " + in_quotes(name) + " is rendered as 'clamp'");
  set_attribute(*mode, "value", "clamp");
}

}  // namespace

void replace_texture(Element& texture, StandInNotes& notes) {
  if (value_of(texture, "type") != "bitmap") return;
  replace_gamma(texture, notes);
  replace_wrap_mode(texture, notes);
  if (const Element channel = take_parameter(texture, "channel"); !channel.tag.empty())
    notes.add(channel,
              "channel " + in_quotes(value_of(channel, "value")) + " is left out: the texture has all its channels");
  if (Element* filter = parameter_of(texture, "filter_type"))
    if (value_of(*filter, "value") == "ewa" || value_of(*filter, "value") == "trilinear")
      set_attribute(*filter, "value", "bilinear");
}

}  // namespace photonproof::scene_xml
