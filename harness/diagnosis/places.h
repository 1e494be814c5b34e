// The place of something in a picture, in words, from the objects that the scene shows there.
#pragma once

#include <string>
#include <vector>

#include "harness/diagnosis/diagnosis.h"

namespace photonproof::inline harness_diagnosis {

/// "below the glass sphere", "on the left wall", "in the mirror sphere", "in the lower right corner"; empty where it is
/// everywhere. `weight`: for each pixel, the amount there. `knowledge.seen` has the image's size, too; otherwise the
/// words name only parts of the image.
std::string place_of(const std::vector<double>& weight, int width, int height, const SceneKnowledge& knowledge);

/// Whether a landmark of this name is a body in the room, and not a wall, a light or water.
bool names_object(const std::string& name);

/// The least rectangle with nine tenths of the weight.
PixelRegion region_of(const std::vector<double>& weight, int width, int height);

/// The part of the image around a point: "lower right corner", "middle".
std::string part_of_image(double x, double y, int width, int height);

}  // namespace photonproof::inline harness_diagnosis
