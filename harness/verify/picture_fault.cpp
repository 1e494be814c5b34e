#include "harness/verify/picture_fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "harness/diagnosis/pictures/picture_changes.h"

namespace photonproof::inline harness_verify {
namespace {

/// Share of the squared difference that may remain after the right correction. A gain alone leaves as much by chance.
constexpr double kLeft = 0.15;

/// Squared difference beyond noise, each pixel relative to its own brightness, so that lights do not dominate.
double unlike(const Image& expected, const EnginePicture& odd, const EnginePicture& right) {
  double sum = 0;
  const Image& seen = odd.rendering.mean;
  for (std::size_t i = 0; i < seen.rgb.size(); ++i) {
    const double e = double{expected.rgb[i]}, x = double{seen.rgb[i]};
    if (!std::isfinite(e)) continue;
    const double noise = double{odd.rendering.variance->rgb[i]} + double{right.rendering.variance->rgb[i]};
    sum += ((x - e) * (x - e) - noise) / (e * e + x * x + 1e-4);
  }
  return std::max(0.0, sum);
}

std::string side_words(double x, double y) {
  std::string words;
  if (std::abs(x) >= 0.1) words = fmt::format("{:.2g} px too far {}", std::abs(x), x > 0 ? "right" : "left");
  if (std::abs(y) >= 0.1)
    words += fmt::format("{}{:.2g} px too far {}", words.empty() ? "" : " and ", std::abs(y), y > 0 ? "down" : "up");
  return words;
}

/// Tries every shift by quarters of a pixel, and reports the smallest that is as good as the best.
std::optional<PictureFault> shifted(const EnginePicture& right, const EnginePicture& odd, double before) {
  constexpr int most = 6;           // quarters
  constexpr double explains = 0.4;  // an edge between pixels is not moved exactly
  double least = explains * before, x = 0, y = 0;
  for (int dy = -most; dy <= most; ++dy)
    for (int dx = -most; dx <= most; ++dx) {
      const double left = unlike(viewed(right.rendering.mean, dx / 4.0, dy / 4.0, 1), odd, right);
      const bool is_nearer = std::hypot(dx, dy) < 4 * std::hypot(x, y);
      if (left > (is_nearer ? 1.02 : 0.98) * least) continue;
      least = std::min(least, left);
      x = dx / 4.0;
      y = dy / 4.0;
    }
  if (side_words(x, y).empty()) return std::nullopt;
  return PictureFault{"camera", "the picture is " + side_words(x, y),
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
  for (const ToneRow& row : tone_rows().subspan(1)) {
    const std::string_view kind = row.kind;
    if (kind != "wrap-around" && kind != "negative")  // requires 8 bits
      consider(toned(light, row, 1), "tone", row.sentence, row.cause);
  }
  if (!best.pass.empty()) return best;
  return shifted(right, odd, before);
}

}  // namespace photonproof::inline harness_verify
