// Emitters as a scene file states them. Only the parser reads the parameters that `also` names. `is_dark` is whether
// the file itself sets the emitter to 0. `scale_lengths` converts it to a scene whose unit of length is 1 / factor.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "scenes/description/given_bool.h"
#include "scenes/description/sun_position.h"
#include "scenes/description/texture_description.h"
#include "scenes/description/view_description.h"
#include "scenes/meshes/ies.h"

namespace photonproof::inline scenes_description {

/// Facts of a kind of emitter on which other code decides.
struct EmitterTraits {
  GivenBool without_size;    ///< one point or one direction: rays never meet it
  GivenBool surrounds;       ///< its light comes from all around and is given by direction
  GivenBool infinitely_far;  ///< its light comes from beyond the scene
};

struct PointLightDescription {
  static constexpr EmitterTraits traits{.without_size = true, .surrounds = false, .infinitely_far = false};
  Vec3d position{0, 0, 0};  ///< world space, to_world applied
  RgbD intensity{1.0};
  bool is_dark() const { return intensity == RgbD(0.0); }
  void scale_lengths(double factor) {
    position *= factor;
    intensity *= factor * factor;
  }
  friend bool operator==(const PointLightDescription&, const PointLightDescription&) = default;
};

template <class P>
void describe(P& p, PointLightDescription& d) {
  p.plugin("point", "the same in all directions");
  p.point("position", d.position, "in world space");
  p.also("to_world", scene_xml::ParamType::transform, "", "or this, whose origin it is");
  p.emission("intensity", d.intensity, "W sr^-1");
}

/// Shines along local +z: in full within the beam, falling linearly with the angle to 0 at the cut-off. `texture` is
/// projected through the cut-off cone's square.
struct SpotLightDescription {
  static constexpr EmitterTraits traits{.without_size = true, .surrounds = false, .infinitely_far = false};
  Transform to_world;
  RgbD intensity{1.0};
  double cutoff_degrees = 20;  ///< half angle
  double beam_degrees = 15;    ///< half angle
  std::optional<TextureIndex> texture = {};
  bool is_dark() const { return intensity == RgbD(0.0); }
  void scale_lengths(double factor) {
    to_world = Transform::scale(Vec3d(factor)) * to_world;
    intensity *= factor * factor;
  }
  friend bool operator==(const SpotLightDescription&, const SpotLightDescription&) = default;
};

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

/// A pinhole that projects an image as a perspective camera would see it: along local +z, +y up, +x left in the image.
/// At a point p and distance z along the axis, what faces the axis gets pi * scale * irradiance(p) * s / z^2, where s
/// is the scale of to_world.
struct ProjectorDescription {
  static constexpr EmitterTraits traits{.without_size = true, .surrounds = false, .infinitely_far = false};
  Colour irradiance = RgbD(1.0);
  double scale = 1;
  double fov_degrees = 50;  ///< full angle, along `fov_axis` of the texture's pixels
  FovAxis fov_axis = FovAxis::x;
  Transform to_world;
  bool is_dark() const { return scale == 0 || irradiance == Colour(RgbD(0.0)); }
  void scale_lengths(double factor) {
    to_world = Transform::scale(Vec3d(factor)) * to_world;
    scale *= factor;
  }
  friend bool operator==(const ProjectorDescription&, const ProjectorDescription&) = default;
};

template <class P>
void describe(P& p, ProjectorDescription& d) {
  p.plugin("projector", "a perspective camera's image, projected along local +z, +y up, +x left in the image");
  p.emission_map("irradiance", d.irradiance, "W m^-2 over pi, one unit ahead");
  p.number("scale", d.scale, scene_xml::kNotNegative, "factor of the irradiance");
  describe_field_of_view(p, d.fov_degrees, d.fov_axis);
  p.transform("to_world", d.to_world, "turns and moves; a scale is a factor of the light, as in Mitsuba");
}

struct DirectionalLightDescription {
  static constexpr EmitterTraits traits{.without_size = true, .surrounds = false, .infinitely_far = true};
  Vec3d direction{0, 0, 1};  ///< world space, unit: the light's direction of travel
  RgbD irradiance{1.0};      ///< on a surface that faces it
  bool is_dark() const { return irradiance == RgbD(0.0); }
  void scale_lengths(double) {}
  friend bool operator==(const DirectionalLightDescription&, const DirectionalLightDescription&) = default;
};

template <class P>
void describe(P& p, DirectionalLightDescription& d) {
  p.plugin("directional", "from far away along local +z");
  p.direction("direction", d.direction, "where the light travels");
  p.also("to_world", scene_xml::ParamType::transform, "", "or this, whose +z it is");
  p.emission("irradiance", d.irradiance, "W m^-2 on what faces it");
}

struct ConstantLightDescription {
  static constexpr EmitterTraits traits{.without_size = false, .surrounds = true, .infinitely_far = true};
  RgbD radiance{1.0};
  bool is_dark() const { return radiance == RgbD(0.0); }
  void scale_lengths(double) {}
  friend bool operator==(const ConstantLightDescription&, const ConstantLightDescription&) = default;
};

template <class P>
void describe(P& p, ConstantLightDescription& d) {
  p.plugin("constant", "the same from all around");
  p.emission("radiance", d.radiance, "W m^-2 sr^-1");
}

/// Latitude-longitude image of the radiance from all around: +y up, the middle of the image towards local +z, +x to the
/// left of it, as in Mitsuba.
struct EnvmapDescription {
  static constexpr EmitterTraits traits{.without_size = false, .surrounds = true, .infinitely_far = true};
  std::string filename;
  std::shared_ptr<const Image> image;  ///< never null
  double scale = 1;
  Transform to_world;
  bool is_dark() const { return scale == 0; }
  void scale_lengths(double) {}
  friend bool operator==(const EnvmapDescription& a, const EnvmapDescription& b) {
    return a.filename == b.filename && a.scale == b.scale && a.to_world == b.to_world;
  }
};

template <class P>
void describe(P& p, EnvmapDescription& d) {
  p.plugin("envmap", "an image from all around, +y up");
  p.file("filename", d.filename, "the name of an image");
  p.number("scale", d.scale, scene_xml::kNotNegative, "factor of the image's radiance");
  p.transform("to_world", d.to_world, "turns it; scales evenly");
}

/// Place and time of the observer, which determine the sun's direction.
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

/// Sun and clear sky; local +z is up, as in Mitsuba's sunsky. The parser turns place and time into the direction.
struct SunSkyDescription {
  static constexpr EmitterTraits traits{.without_size = false, .surrounds = false, .infinitely_far = true};
  Vec3d sun_direction{0, 0, 1};  ///< local, unit, towards the sun
  double turbidity = 3;
  RgbD albedo{0.3};  ///< of the ground
  double sun_scale = 1, sky_scale = 1;
  double sun_aperture_degrees = 0.5358;  ///< full angle
  Transform to_world;
  bool is_dark() const { return sun_scale == 0 && sky_scale == 0; }
  void scale_lengths(double) {}
  friend bool operator==(const SunSkyDescription&, const SunSkyDescription&) = default;
};

template <class P>
void describe(P& p, SunSkyDescription& d) {
  p.plugin("sunsky", "sun and clear sky, +z up");
  p.number("turbidity", d.turbidity, {1, 10}, "haze");
  p.colour("albedo", d.albedo, scene_xml::kShare, "albedo of the ground");
  p.number("sun_scale", d.sun_scale, scene_xml::kNotNegative, "factor of the sun's radiance");
  p.number("sky_scale", d.sky_scale, scene_xml::kNotNegative, "factor of the sky's radiance");
  p.number("sun_aperture", d.sun_aperture_degrees, {0, 90, "more than 0 and less than 90 degrees", true, true},
           "full angle of the sun");
  p.sun(d.sun_direction, d.to_world, "in world space, towards the sun; or its place and time:");
  p.transform("to_world", d.to_world, "turns, moves and scales evenly");
}

/// Extension: a point light with the measured distribution of an IES LM-63 file. The luminaire's nadir is local -z, its
/// C0 plane local +x. Candela count as W sr^-1, times `intensity`.
struct IesLightDescription {
  static constexpr EmitterTraits traits{.without_size = true, .surrounds = false, .infinitely_far = false};
  std::string filename;
  std::shared_ptr<const IesProfile> profile;  ///< never null
  RgbD intensity{1.0};
  Transform to_world;
  bool is_dark() const { return intensity == RgbD(0.0); }
  void scale_lengths(double factor) {
    to_world = Transform::scale(Vec3d(factor)) * to_world;
    intensity *= factor * factor;
  }
  friend bool operator==(const IesLightDescription& a, const IesLightDescription& b) {
    return a.filename == b.filename && a.intensity == b.intensity && a.to_world == b.to_world;
  }
};

template <class P>
void describe(P& p, IesLightDescription& d) {
  p.plugin("ies", "extension: a point light with the distribution of an IES LM-63 file; candela count as W sr^-1");
  p.file("filename", d.filename, "the name of an IES file");
  p.emission("intensity", d.intensity, "factor of the candela");
  p.transform("to_world", d.to_world, "turns, moves and scales evenly");
}

/// The emitter of a shape.
struct AreaEmitter {
  Colour radiance = RgbD(1.0);
};

template <class P>
void describe(P& p, AreaEmitter& d) {
  p.plugin("area", "in a shape, on its front");
  p.emission_map("radiance", d.radiance, "W m^-2 sr^-1");
}

/// The emitter of a flat shape whose light leaves along the shape's normal alone.
struct DirectionalAreaEmitter {
  RgbD radiance = RgbD(1.0);
};

template <class P>
void describe(P& p, DirectionalAreaEmitter& d) {
  p.plugin("directionalarea", "in a rectangle or disk: a beam along its normal; unseen itself");
  p.emission("radiance", d.radiance, "W m^-2 across the beam");
}

struct EmitterDescription {
  SourceLoc loc;
  std::string id;
  std::variant<PointLightDescription, SpotLightDescription, DirectionalLightDescription, ConstantLightDescription,
               EnvmapDescription, SunSkyDescription, IesLightDescription, ProjectorDescription>
      light;
};

}  // namespace photonproof::inline scenes_description
