#include "harness/verify/picture_fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/diagnosis/comparison.h"
#include "harness/diagnosis/picture_changes.h"
#include "harness/diagnosis/sub_pixel_shift.h"

namespace photonproof {
namespace {

/// What a change leaves of the squared difference where it is the fault; a gain alone leaves as much by chance.
constexpr double kLeft = 0.15;

/// Squared difference beyond noise, each pixel relative to its own brightness, so that lamps do not decide.
double unlike(const Image& expected, const EnginePicture& odd, const EnginePicture& right) {
  double sum = 0;
  const Image& seen = odd.rendering.mean;
  for (std::size_t i = 0; i < seen.rgb.size(); ++i) {
    const double e = double{expected.rgb[i]}, x = double{seen.rgb[i]};
    if (!std::isfinite(e)) continue;
    const double noise = double{odd.rendering.variance->rgb[i]} + double{right.rendering.variance->rgb[i]};
    sum += std::max(0.0, (x - e) * (x - e) - noise) / (e * e + x * x + 1e-4);
  }
  return sum;
}

std::string side_words(double x, double y) {
  std::string words;
  if (std::abs(x) >= 0.1) words = fmt::format("{:.2g} px too far {}", std::abs(x), x > 0 ? "right" : "left");
  if (std::abs(y) >= 0.1)
    words += fmt::format("{}{:.2g} px too far {}", words.empty() ? "" : " and ", std::abs(y), y > 0 ? "down" : "up");
  return words;
}

std::optional<PictureFault> shifted(const EnginePicture& right, const EnginePicture& odd, double before) {
  const Comparison comparison(odd.rendering.mean, std::nullopt, 0.0, {});
  const std::optional<SubPixelShift> shift = sub_pixel_shift(right.rendering.mean, comparison);
  if (!shift || side_words(shift->x, shift->y).empty()) return std::nullopt;
  const double left = unlike(viewed(right.rendering.mean, shift->x, shift->y, 1), odd, right);
  // Pixels between which an edge runs are not moved exactly.
  if (left > 0.4 * before || shift->deviations < 5) return std::nullopt;
  return PictureFault{"camera", "the picture is " + side_words(shift->x, shift->y),
                      "the camera's axis or the middle of a pixel is taken elsewhere"};
}

}  // namespace

std::optional<PictureFault> picture_fault(const EnginePicture& right, const EnginePicture& odd) {
  const Image& light = right.rendering.mean;
  const double before = unlike(light, odd, right);
  PictureFault best;
  double least = kLeft * before;
  const auto consider = [&](const Image& changed, const char* pass, const char* sentence, const char* cause) {
    const double left = unlike(changed, odd, right);
    if (left >= least) return;
    least = left;
    best = {pass, sentence, cause};
  };
  for (const TurnRow& row : turn_rows().subspan(1))
    if (!row.swaps_sides || light.width == light.height)
      consider(turned(light, row), "camera", row.sentence, row.cause);
  for (const ChannelRow& row : channel_rows().subspan(1))
    consider(with_channels(light, row), "tone", row.sentence, row.cause);
  for (const ToneRow& row : tone_rows().subspan(1)) consider(toned(light, row, 1), "tone", row.sentence, row.cause);
  if (!best.pass.empty()) return best;
  return shifted(right, odd, before);
}

}  // namespace photonproof
