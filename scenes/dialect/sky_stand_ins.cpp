#include "scenes/dialect/sky_stand_ins.h"

namespace photonproof::scene_xml {
namespace {

/// Its local +z becomes +y before its own to_world.
void turn_up(Element& emitter) {
  Element up = new_element(emitter, "rotate");
  set_attribute(up, "x", "1");
  set_attribute(up, "angle", "-90");
  Element to_world = take_parameter(emitter, "to_world");
  if (to_world.tag.empty()) {
    to_world = new_element(emitter, "transform");
    set_attribute(to_world, "name", "to_world");
  }
  to_world.children.insert(to_world.children.begin(), std::move(up));
  emitter.children.push_back(std::move(to_world));
}

}  // namespace

void replace_sky(Element& emitter, StandInNotes& notes) {
  const std::string type = value_of(emitter, "type");
  if (type != "sun" && type != "sky" && type != sunsky_of_old) return;
  notes.add_stand_in(emitter, "sunsky", "its radiance is that of Mitsuba 3's model");
  set_attribute(emitter, "type", "sunsky");
  if (type != sunsky_of_old) {
    const bool sun = type == "sun";
    rename_parameter(emitter, "scale", sun ? "sun_scale" : "sky_scale");
    take_parameter(emitter, sun ? "sky_scale" : "sun_scale");
    add_parameter(emitter, "float", sun ? "sky_scale" : "sun_scale", "0");
  }
  for (const char* name : {"stretch", "resolution", "extend", "sun_radius_scale"}) take_parameter(emitter, name);
  turn_up(emitter);
}

}  // namespace photonproof::scene_xml
