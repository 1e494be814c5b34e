// Emitters as a scene file has them (describe_bsdfs.h says how). What `also` names only the parser reads.
#pragma once

#include "scenes/description/description.h"
#include "scenes/description/sun_position.h"
#include "scenes/xml/param_type.h"

namespace photonproof {

/// The emitter of a shape.
struct AreaEmitter {
  Colour radiance = RgbD(1.0);
};

template <class P>
void describe(P& p, AreaEmitter& d) {
  p.plugin("area", "in a shape, on its front");
  p.emission_map("radiance", d.radiance, "W m^-2 sr^-1");
}

template <class P>
void describe(P& p, PointLightDescription& d) {
  p.plugin("point", "the same in all directions");
  p.point("position", d.position, "in world space");
  p.also("to_world", scene_xml::ParamType::transform, "", "or this, whose origin it is");
  p.emission("intensity", d.intensity, "W sr^-1");
}

template <class P>
void describe(P& p, SpotLightDescription& d) {
  p.plugin("spot", "along local +z");
  p.transform("to_world", d.to_world, "turns, moves and scales evenly");
  p.emission("intensity", d.intensity, "W sr^-1 within the beam");
  p.number("cutoff_angle", d.cutoff_degrees, {0, 90, "more than 0 and less than 90 degrees", true, true},
           "half the angle of all light");
  p.number_after("beam_width", d.beam_degrees, d.cutoff_degrees * 3 / 4, "3/4 of `cutoff_angle`",
                 "half the angle of the full intensity, at most `cutoff_angle`");
  p.optional_texture("texture", d.texture, "projected through the square about the light's cone");
}

template <class P>
void describe(P& p, DirectionalLightDescription& d) {
  p.plugin("directional", "from far away along local +z");
  p.direction("direction", d.direction, "where the light travels");
  p.also("to_world", scene_xml::ParamType::transform, "", "or this, whose +z it is");
  p.emission("irradiance", d.irradiance, "W m^-2 on what faces it");
}

template <class P>
void describe(P& p, ConstantLightDescription& d) {
  p.plugin("constant", "the same from all around");
  p.emission("radiance", d.radiance, "W m^-2 sr^-1");
}

template <class P>
void describe(P& p, EnvmapDescription& d) {
  p.plugin("envmap", "an image from all around, +y up");
  p.file("filename", d.filename, "the name of an image");
  p.number("scale", d.scale, scene_xml::kNotNegative, "factor of the image's radiance");
  p.transform("to_world", d.to_world, "turns it; scales evenly");
}

/// Where and when the sun is seen, in place of its direction.
template <class P>
void describe(P& p, PlaceAndTime& d) {
  p.number("latitude", d.latitude_degrees, {-90, 90}, "degrees north");
  p.number("longitude", d.longitude_degrees, {-180, 180}, "degrees east");
  p.number("timezone", d.timezone_hours, {-24, 24}, "hours ahead of UTC");
  p.integer("year", d.year, 1, 9999, "");
  p.integer("month", d.month, 1, 12, "");
  p.integer("day", d.day, 1, 31, "");
  p.number("hour", d.hour, {0, 24}, "");
  p.number("minute", d.minute, {0, 60}, "");
  p.number("second", d.second, {0, 60}, "");
}

template <class P>
void describe(P& p, SunSkyDescription& d) {
  p.plugin("sunsky", "sun and clear sky, +z up");
  p.number("turbidity", d.turbidity, {1, 10}, "haze");
  p.colour("albedo", d.albedo, scene_xml::kShare, "of the ground");
  p.number("sun_scale", d.sun_scale, scene_xml::kNotNegative, "factor of the sun's radiance");
  p.number("sky_scale", d.sky_scale, scene_xml::kNotNegative, "factor of the sky's radiance");
  p.number("sun_aperture", d.sun_aperture_degrees, {0, 90, "more than 0 and less than 90 degrees", true, true},
           "full angle of the sun");
  p.sun(d.sun_direction, d.to_world, "in world space, towards the sun; or its place and time:");
  p.transform("to_world", d.to_world, "turns, moves and scales evenly");
}

template <class P>
void describe(P& p, IesLightDescription& d) {
  p.plugin("ies", "extension: a point light with the distribution of an IES LM-63 file; candela count as W sr^-1");
  p.file("filename", d.filename, "the name of an IES file");
  p.emission("intensity", d.intensity, "factor of the candela");
  p.transform("to_world", d.to_world, "turns, moves and scales evenly");
}

}  // namespace photonproof
