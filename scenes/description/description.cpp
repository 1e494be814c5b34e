#include "scenes/description/description.h"

#include <algorithm>
#include <cmath>

namespace photonproof::inline scenes_description {
namespace {

struct Nested {
  std::vector<BsdfIndex> operator()(const TwoSidedDescription& d) const { return {d.front, d.back}; }
  std::vector<BsdfIndex> operator()(const MaskDescription& d) const { return {d.nested}; }
  std::vector<BsdfIndex> operator()(const BlendDescription& d) const { return {d.first, d.second}; }
  std::vector<BsdfIndex> operator()(const BumpMapDescription& d) const { return {d.nested}; }
  std::vector<BsdfIndex> operator()(const NormalMapDescription& d) const { return {d.nested}; }
  std::vector<BsdfIndex> operator()(const LayeredDescription& d) const { return {d.base}; }
  std::vector<BsdfIndex> operator()(const LeafBsdf auto&) const { return {}; }
};

}  // namespace

std::vector<BsdfIndex> nested_bsdfs(const BsdfDescription& bsdf) { return std::visit(Nested{}, bsdf.model); }

void FilmDescription::resize(int new_width, int new_height) {
  const auto scale = [](int& place, int& size, int old_side, int new_side) {
    const auto border = [&](int at) { return static_cast<int>(std::lround(double(at) * new_side / old_side)); };
    const int first = std::min(border(place), new_side - 1), end = border(place + size);
    place = first;
    size = std::max(end - first, 1);
  };
  if (crop) {
    scale(crop->x, crop->width, width, new_width);
    scale(crop->y, crop->height, height, new_height);
  }
  width = new_width;
  height = new_height;
}

double EllipsoidsDescription::reach(std::size_t i) const {
  constexpr double least_response = 0.01;
  if (!adapts_extent || cloud->opacities.empty()) return extent;
  const double logarithm = std::log(double{cloud->opacities[i]} / least_response);
  return logarithm > 0 ? extent * std::sqrt(2 * logarithm) / 3 : 0;
}

std::string SceneDescription::where(const SourceLoc& loc) const {
  const bool known_file = loc.file >= 0 && static_cast<std::size_t>(loc.file) < files.size();
  std::string file = known_file ? files[static_cast<std::size_t>(loc.file)] : "<scene>";
  if (loc.line <= 0) return file;
  return file + ":" + std::to_string(loc.line) + ":" + std::to_string(loc.column);
}

}  // namespace photonproof::inline scenes_description
