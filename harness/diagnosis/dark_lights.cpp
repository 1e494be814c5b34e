#include "harness/diagnosis/dark_lights.h"

#include <cstddef>
#include <vector>

#include "harness/diagnosis/places.h"

namespace photonproof::inline harness_diagnosis {
namespace {

/// Fractions of white: a value of at least `white_part` is cut there; one below `dark_part` is clearly darker.
constexpr double white_part = 0.999, dark_part = 0.95;
/// The least number of values at white, as fewer may be a highlight, and the least dark share, as less may be an edge.
constexpr std::size_t least_values = 12;
constexpr double least_part = 0.6;

}  // namespace

std::optional<Finding> find_dark_lights(const Image& submitted, const SceneKnowledge& knowledge) {
  if (!knowledge.white) return std::nullopt;
  const double white = *knowledge.white;
  const Image& reference = knowledge.reference;
  std::vector<double> weight(reference.pixels());
  std::size_t at_white = 0, dark = 0;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    if (double{reference.rgb[i]} < white_part * white) continue;
    ++at_white;
    if (!(double{submitted.rgb[i]} < dark_part * white)) continue;
    ++dark;
    weight[i / 3] = 1;
  }
  if (at_white < least_values || static_cast<double>(dark) < least_part * static_cast<double>(at_white))
    return std::nullopt;
  return Finding{"white-is-dark", "the lamp, which is brighter than white, comes out dark",
                 "values above 255 wrap around in 8 bits instead of being cut, or the lamp is drawn too dark",
                 region_of(weight, reference.width, reference.height), 1};
}

}  // namespace photonproof::inline harness_diagnosis
