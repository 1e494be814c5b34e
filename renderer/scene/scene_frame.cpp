#include "renderer/scene/scene_frame.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "renderer/scene/scene_focus.h"
#include "renderer/shapes/surface.h"
#include "scenes/base/numeric_faults.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_scene {
namespace {

/// Median; for an even number the mean of the two middle values.
double median(std::vector<double> values) {
  const std::size_t middle = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// The floor is the reach over this. Near the origin coordinates are small, but they result from larger ones.
constexpr double parts_of_reach = 2;
/// Beyond this multiple of the focus's size, coordinates and offsets cost it precision: there, four ulp are a
/// ten-thousandth of it.
constexpr double unlike = 256;
/// The floor is no less than this part of the focus, where offsets by ulps of it do not show.
constexpr double part_of_focus = 0x1p-4;
/// Embree's hit on a face is exact to about 2^-24 of its length, and rays leave by 2^-21 of the floor. So faces longer
/// than this many floors would shade themselves (at 64 some do, sizes_test.cpp).
constexpr double long_in_floors = 16;

SceneFrame frame_of_middles(const SceneDescription& description) {
  const ShapeExtents shape_extents(description);
  std::vector<Extent> extents;
  for (const ShapeDescription& shape : description.shapes) {
    const Extent extent = shape_extents.of(shape);
    if (extent.is_usable()) extents.push_back(extent);
  }
  if (extents.empty()) return {};

  std::vector<double> x, y, z, reach;
  for (const Extent& e : extents) {
    const Vec3d middle = e.middle();
    x.push_back(middle.x);
    y.push_back(middle.y);
    z.push_back(middle.z);
  }
  // Whole floats, so that adding it to what is near it loses nothing that matters.
  const Vec3d origin(Vec3f(Vec3d(median(x), median(y), median(z))));
  if (!is_finite(origin)) return {};
  for (const Extent& e : extents) {
    const Vec3d low = e.low - origin, high = e.high - origin;
    reach.push_back(std::max({-low.x, -low.y, -low.z, high.x, high.y, high.z}));
  }
  return {1, -origin, static_cast<float>(median(reach) / parts_of_reach)};
}

}  // namespace

double power_of_two_below(double x) { return std::ldexp(1.0, std::ilogb(x)); }

Extent extent_of(const ShapeDescription& shape) {
  Extent extent;
  const auto add_box = [&](double height) { extent.add_box(shape.to_world, {-1, -1, -height}, {1, 1, height}); };
  std::visit(Overloaded{[&](const RectangleDescription&) { add_box(0); }, [&](const CubeDescription&) { add_box(1); },
                        [&](const HeightfieldDescription& field) { add_box(std::abs(field.amplitude)); },
                        [&](const MeshDescription& mesh) {
                          for (const Vec3f& p : mesh.mesh->positions) extent.add(shape.to_world.point(Vec3d(p)));
                        },
                        [&](const InstanceDescription&) {},
                        [&](const auto& primitive) { extent = extent_of(primitive, shape.to_world); }},
             shape.geometry);
  return extent;
}

ShapeExtents::ShapeExtents(const SceneDescription& description) {
  for (const ShapeGroupDescription& group : description.groups) {
    Extent extent;
    for (const ShapeDescription& member : group.shapes) {
      const Extent part = extent_of(member);
      if (part.is_usable()) extent.add(part);
    }
    groups_.push_back(extent);
  }
}

Extent ShapeExtents::of(const ShapeDescription& shape) const {
  const auto* instance = std::get_if<InstanceDescription>(&shape.geometry);
  if (instance == nullptr) return extent_of(shape);
  const Extent& group = groups_[instance->group.value];
  Extent extent;
  if (group.is_usable()) extent.add_box(shape.to_world, group.low, group.high);
  return extent;
}

namespace {

bool has_curves(const SceneDescription& description) {
  const auto is_curves = [](const ShapeDescription& shape) {
    return std::holds_alternative<CurvesDescription>(shape.geometry);
  };
  return std::ranges::any_of(description.shapes, is_curves) ||
         std::ranges::any_of(description.groups, [&](const ShapeGroupDescription& group) {
           return std::ranges::any_of(group.shapes, is_curves);
         });
}

SceneFrame frame_of_focus(const SceneDescription& description) {
  SceneFrame frame = frame_of_middles(description);
  const std::optional<SceneFocus> focus = scene_focus(description);
  if (!focus) return frame;
  if (!(length(frame.moved + focus->point) <= unlike * focus->size) ||
      !(frame.coordinate_floor * parts_of_reach <= unlike * focus->size)) {
    // Whole floats, so that adding it to what is near it loses nothing that matters.
    const Vec3d origin(Vec3f(focus->point));
    if (is_finite(origin)) frame.moved = -origin;
    // Not a part of the focus alone, since faces extend far beyond it.
    frame.coordinate_floor = std::min(frame.coordinate_floor, static_cast<float>(16 * focus->size));
  }
  frame.coordinate_floor = std::max(frame.coordinate_floor, static_cast<float>(part_of_focus * focus->size));
  if (!has_fault(NumericFault::float_faces)) frame.long_edge = long_in_floors * double{frame.coordinate_floor};
  const double ordinary = has_curves(description) ? ordinary_size_with_curves : ordinary_size;
  const bool is_ordinary = focus->size >= 1 / ordinary && focus->size <= ordinary;
  if (is_ordinary || has_fault(NumericFault::no_rescaling)) return frame;
  frame.scale = power_of_two_below(1 / focus->size);
  frame.moved = Vec3d(Vec3f(frame.moved * frame.scale));
  frame.coordinate_floor = static_cast<float>(frame.coordinate_floor * frame.scale);
  frame.long_edge *= frame.scale;
  return frame;
}

}  // namespace

SceneFrame scene_frame(const SceneDescription& description) {
  SceneFrame frame = frame_of_focus(description);
  if (has_fault(NumericFault::no_recentring)) frame.moved = Vec3d(0.0);
  return frame;
}

}  // namespace photonproof::inline renderer_scene
