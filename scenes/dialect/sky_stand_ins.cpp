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

/// The sun of a span of days and hours stands still at its beginning.
void stop_time(Element& emitter, StandInNotes& notes) {
  notes.add_stand_in(emitter, "sunsky", "the sun stands still at its first day and hour");
  set_attribute(emitter, "type", "sunsky");
  rename_parameter(emitter, "start_year", "year");
  rename_parameter(emitter, "start_month", "month");
  rename_parameter(emitter, "start_day", "day");
  const Element hour = take_parameter(emitter, "window_start_time");
  add_parameter(emitter, "float", "hour", hour.tag.empty() ? "7" : value_of(hour, "value"));
  for (const char* name : {"end_year", "end_month", "end_day", "window_end_time", "shutter_open", "shutter_close"})
    take_parameter(emitter, name);
}

}  // namespace

void replace_sky(Element& emitter, StandInNotes& notes) {
  if (value_of(emitter, "type") == "timed_sunsky") stop_time(emitter, notes);
  const std::string type = value_of(emitter, "type");
  if (type == "sunsky")
    if (const Element complex = take_parameter(emitter, "complex_sun"); value_of(complex, "value") == "true")
      notes.add(complex, "complex_sun is left out: the sun is as bright at its rim as in its middle");
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
