// Where something is in a picture, in words: by what the scene shows there.
#pragma once

#include <string>
#include <vector>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {

/// "below the glass sphere", "on the left wall", "in the mirror sphere", "in the lower right corner"; empty where it is
/// everywhere. `weight`: a pixel, how much of it is there, of an image of this size, which `knowledge.seen` has, too,
/// or words go by the image's parts alone.
std::string place_of(const std::vector<double>& weight, int width, int height, const SceneKnowledge& knowledge);

/// Whether a landmark of this name is a body in the room, and none of its walls, lights or waters.
bool names_body(const std::string& name);

/// The least rectangle with nine tenths of the weight.
PixelRegion region_of(const std::vector<double>& weight, int width, int height);

/// "lower right corner", "middle", of a point.
std::string part_of_image(double x, double y, int width, int height);

}  // namespace photonproof::inline harness_diagnosis
