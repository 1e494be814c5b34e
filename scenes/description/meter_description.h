// Sensors that measure instead of showing a picture, as a scene file states them. Their films have one pixel.
#pragma once

#include <variant>

#include "scenes/base/vec.h"
#include "scenes/description/param_type.h"
#include "scenes/description/transform.h"

namespace photonproof::inline scenes_description {

template <class P>
void describe_meter(P& p) {
  p.also("shutter_open", scene_xml::ParamType::number, "0", "nothing moves: without effect");
  p.also("shutter_close", scene_xml::ParamType::number, "0", "at least `shutter_open`: without effect");
  p.nested("film", 1, "a film of 1 x 1 pixel");
  p.nested("sampler", 1, "a sampler");
  p.nested("medium", 1, "the medium around the camera");
}

/// The radiance along one ray, from the local origin along local +z.
struct RadianceMeterDescription {
  friend bool operator==(const RadianceMeterDescription&, const RadianceMeterDescription&) = default;
};

template <class P>
void describe(P& p, RadianceMeterDescription&) {
  p.plugin("radiancemeter", "the radiance along one ray; not for `bdpt` and `ptracer`");
  p.also("to_world", scene_xml::ParamType::transform, "", "turns and moves the ray from the origin along +z");
  p.also("origin", scene_xml::ParamType::point, "", "with `direction` in place of `to_world`");
  p.also("direction", scene_xml::ParamType::point, "", "the ray's");
  describe_meter(p);
}

/// The mean over a shape's front of the irradiance there. The shape has `measures` set.
struct IrradianceMeterDescription {
  friend bool operator==(const IrradianceMeterDescription&, const IrradianceMeterDescription&) = default;
};

template <class P>
void describe(P& p, IrradianceMeterDescription&) {
  p.plugin("irradiancemeter",
           "in a rectangle or a disk: the mean irradiance on its front; not for `bdpt` and `ptracer`");
  describe_meter(p);
}

/// The square [-1,1]^2 in the local xy plane or the unit disc in it.
struct TargetArea {
  bool is_disk = false;
  Transform to_world;
  friend bool operator==(const TargetArea&, const TargetArea&) = default;
};

/// The mean radiance of parallel rays along local +z, from beyond all shapes: through a point, to an area, or through
/// the disc across the ball around the shapes.
struct DistantDescription {
  std::variant<std::monostate, Vec3d, TargetArea> target;
  friend bool operator==(const DistantDescription&, const DistantDescription&) = default;
};

template <class P>
void describe(P& p, DistantDescription&) {
  p.plugin("distant", "the mean radiance of parallel rays from beyond all shapes; not for `bdpt` and `ptracer`");
  p.also("to_world", scene_xml::ParamType::transform, "", "turns the rays, which are along +z");
  p.also("direction", scene_xml::ParamType::point, "", "the rays', in place of `to_world`");
  p.also("target", scene_xml::ParamType::point, "", "where a single ray leads");
  p.nested("shape", 1, "a rectangle or disk named `target`, to all of whose points rays lead; else to all shapes");
  describe_meter(p);
}

}  // namespace photonproof::inline scenes_description
