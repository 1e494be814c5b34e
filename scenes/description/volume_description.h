// Volumes as a scene file states them: values that vary in space.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "scenes/base/vec.h"
#include "scenes/description/param_type.h"
#include "scenes/description/texture_wrap.h"
#include "scenes/description/transform.h"
#include "scenes/meshes/vol.h"

namespace photonproof::inline scenes_description {

enum class VolumeFilter { trilinear, nearest };

/// A grid over the unit cube, which to_world places in the world. Cell i of n has its centre at (i + 0.5) / n.
struct GridVolumeDescription {
  std::string filename;                    ///< as the scene spells it
  std::shared_ptr<const VolumeGrid> grid;  ///< never null; shared by the volumes that name the same file
  bool raw = false;                        ///< without effect: values are numbers
  VolumeFilter filter = VolumeFilter::trilinear;
  TextureWrap wrap = TextureWrap::clamp;
  bool use_grid_bbox = false;  ///< the grid is over the file's box in place of the unit cube
  Transform to_world;
  friend bool operator==(const GridVolumeDescription& a, const GridVolumeDescription& b) {
    return a.filename == b.filename && a.raw == b.raw && a.filter == b.filter && a.wrap == b.wrap &&
           a.use_grid_bbox == b.use_grid_bbox && a.to_world == b.to_world;
  }
};

template <class P>
void describe(P& p, GridVolumeDescription& d) {
  p.plugin("gridvolume", "a grid over the unit cube; cell i of n has its centre at (i + 0.5) / n");
  p.file("filename", d.filename, "the name of a .vol file");
  p.boolean("raw", d.raw, "without effect: values are numbers");
  p.choice("filter_type", d.filter, {{"trilinear", VolumeFilter::trilinear}, {"nearest", VolumeFilter::nearest}},
           "between cells");
  p.choice("wrap_mode", d.wrap,
           {{"clamp", TextureWrap::clamp}, {"repeat", TextureWrap::repeat}, {"mirror", TextureWrap::mirror}},
           "beyond the outer cells");
  p.boolean("use_grid_bbox", d.use_grid_bbox, "over the file's box in place of the unit cube");
  p.transform("to_world", d.to_world, "places the grid; it has an inverse");
}

/// The same everywhere. A medium of this extinction ends at the unit cube, which to_world places in the world.
struct ConstantVolumeDescription {
  RgbD value{1.0};
  Transform to_world;
  friend bool operator==(const ConstantVolumeDescription&, const ConstantVolumeDescription&) = default;
};

template <class P>
void describe(P& p, ConstantVolumeDescription& d) {
  p.plugin("constvolume", "the same everywhere; as `sigma_t` it places the medium's box");
  p.colour("value", d.value, scene_xml::kNotNegative, "a colour or a number");
  p.transform("to_world", d.to_world, "places the unit cube; it has an inverse");
}

/// A colour, or a volume that gives one at every point. The box of a colour is the unit cube.
using VolumeColour = std::variant<RgbD, GridVolumeDescription, ConstantVolumeDescription>;

/// The value of one that is the same everywhere, else null.
inline const RgbD* constant_of(const VolumeColour& v) {
  if (const auto* volume = std::get_if<ConstantVolumeDescription>(&v)) return &volume->value;
  return std::get_if<RgbD>(&v);
}
inline RgbD* constant_of(VolumeColour& v) {
  if (auto* volume = std::get_if<ConstantVolumeDescription>(&v)) return &volume->value;
  return std::get_if<RgbD>(&v);
}

/// From the cube over which the values are given to the world.
inline Transform place_of(const VolumeColour& v) {
  if (const auto* volume = std::get_if<ConstantVolumeDescription>(&v)) return volume->to_world;
  const auto* grid = std::get_if<GridVolumeDescription>(&v);
  return grid != nullptr ? grid->to_world : Transform();
}

/// A number, or a volume of one channel that gives one at every point.
using VolumeNumber = std::variant<double, GridVolumeDescription>;

/// Every component is at most that of this.
inline RgbD most(const VolumeColour& v) {
  const RgbD* constant = constant_of(v);
  return constant != nullptr ? *constant : RgbD(double{std::get<GridVolumeDescription>(v).grid->largest});
}

}  // namespace photonproof::inline scenes_description
