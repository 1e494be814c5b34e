// pbrt's curves as tubes. A scene of hair has a directive for each, so that those of one material become one shape.
#pragma once

#include <map>
#include <utility>

#include "scenes/curves/curve_set.h"
#include "scenes/pbrt/state.h"

namespace photonproof::inline scenes_pbrt {

class PbrtCurves {
 public:
  explicit PbrtCurves(PbrtContext& context) : context_(context) {}

  /// The directive Shape "curve", placed by `to_world`. `group` is the number of an object, or -1 for the scene. Throws
  /// InputError.
  void add(const PbrtParameters& parameters, const Transform& to_world, BsdfIndex bsdf, int group);
  /// Writes the curves' files and adds their shapes to the scene and its groups.
  void finish();

 private:
  PbrtContext& context_;
  std::map<std::pair<int, std::uint32_t>, CurveSet> sets_;  ///< by group and BSDF
};

}  // namespace photonproof::inline scenes_pbrt
