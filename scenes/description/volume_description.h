// Volumes as a scene file states them: values that vary in space.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "scenes/description/param_type.h"
#include "scenes/description/texture_description.h"
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

/// A colour, or a volume that gives one at every point.
using VolumeColour = std::variant<RgbD, GridVolumeDescription>;

/// Every component is at most that of this.
inline RgbD most(const VolumeColour& v) {
  const auto* volume = std::get_if<GridVolumeDescription>(&v);
  return volume != nullptr ? RgbD(double{volume->grid->largest}) : std::get<RgbD>(v);
}

}  // namespace photonproof::inline scenes_description
