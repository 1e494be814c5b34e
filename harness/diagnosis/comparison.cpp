#include "harness/diagnosis/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "harness/pixels/middle_of.h"

namespace photonproof {

Comparison::Comparison(const Image& submitted, std::optional<float> white, double tolerance,
                       std::vector<std::uint8_t> ignored)
    : submitted_(submitted), tolerance_(tolerance), ignored_(std::move(ignored)) {
  float most = 0;
  for (const float v : submitted.rgb)
    if (std::isfinite(v)) most = std::max(most, v);
  white_ = white ? double{*white} : std::max(1.0, double{most});
  shown_ = shown_of(submitted_);
  pixel_variance_ = variances(shown_);
  noise_ = noise_of(submitted_);
}

double Comparison::shown(double v) const { return std::sqrt(std::clamp(v, 0.0, white_) / white_); }

std::vector<float> Comparison::shown_of(const Image& image) const {
  std::vector<float> values(image.rgb.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] =
        std::isfinite(image.rgb[i]) ? static_cast<float>(shown(image.rgb[i])) : std::numeric_limits<float>::quiet_NaN();
  return values;
}

/// Half the mean square of differences of neighbours is the variance of noise that neighbours do not share. Over the
/// block and a pixel around it.
std::vector<float> Comparison::variances(const std::vector<float>& values) const {
  std::vector<float> result(static_cast<std::size_t>(across()) * static_cast<std::size_t>(down()) * 3);
  const auto at = [&](int x, int y, int c) {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x);
    return counts(pixel) ? values[3 * pixel + static_cast<std::size_t>(c)] : std::numeric_limits<float>::quiet_NaN();
  };
  std::size_t i = 0;
  for (int by = 0; by < height(); by += side)
    for (int bx = 0; bx < width(); bx += side)
      for (int c = 0; c < 3; ++c, ++i) {
        double sum = 0, count = 0;
        for (int y = std::max(0, by - 1); y < std::min(height() - 1, by + side + 1); ++y)
          for (int x = std::max(0, bx - 1); x < std::min(width() - 1, bx + side + 1); ++x)
            for (const float next : {at(x + 1, y, c), at(x, y + 1, c)}) {
              const double d = next - at(x, y, c);
              if (!std::isfinite(d)) continue;
              sum += d * d / 2;
              count += 1;
            }
        result[i] = count > 0 ? static_cast<float>(sum / count) : 0;
      }
  return result;
}

Excess Comparison::excess(const Image& guess) const {
  constexpr double deviations = 3, shared = 2.5;  // noise of photon maps is shared by neighbours
  const std::vector<float> expected = shown_of(guess);
  std::vector<float> difference(expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) difference[i] = shown_[i] - expected[i];
  const std::vector<float> apart = variances(difference);
  Excess result;
  result.block.resize(static_cast<std::size_t>(across()) * static_cast<std::size_t>(down()));
  std::size_t block = 0, i = 0, compared = 0, comparable = 0;
  for (int by = 0; by < height(); by += side)
    for (int bx = 0; bx < width(); bx += side, ++block)
      for (int c = 0; c < 3; ++c, ++i) {
        double sum = 0, level = 0, count = 0, counted = 0;
        for (int y = by; y < std::min(by + side, height()); ++y)
          for (int x = bx; x < std::min(bx + side, width()); ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x);
            const std::size_t at = 3 * pixel + static_cast<std::size_t>(c);
            counted += counts(pixel) ? 1 : 0;
            if (!counts(pixel) || !std::isfinite(difference[at])) continue;
            sum += difference[at];
            level += expected[at];
            count += 1;
          }
        comparable += counted < 4 ? 0 : 1;
        if (count < 4) continue;
        ++compared;
        level /= count;
        const double variance = std::min(pixel_variance_[i], apart[i]);
        const double rounding = 0.5 / 255 / (2 * std::max(level, 0.06));
        const double allowed =
            deviations * std::sqrt(shared * variance / count) + tolerance_ / 2 * level + rounding + 0.004;
        const double over = std::max(0.0, std::abs(sum / count) - allowed);
        result.block[block] += over * over;
        result.total += over * over;
      }
  // What a guess does not know counts like the rest; one that knows next to nothing explains nothing.
  constexpr double least_known = 0.05;
  if (static_cast<double>(compared) < least_known * static_cast<double>(comparable)) result.total = unexplained;
  if (compared > 0) result.total *= static_cast<double>(i) / static_cast<double>(compared);
  return result;
}

double Comparison::mismatch(const Image& guess) const {
  constexpr double most = 16;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < guess.rgb.size(); ++i) {
    if (!counts(i / 3)) continue;
    const double d = std::isfinite(guess.rgb[i]) ? shown_[i] - shown(guess.rgb[i]) : 1.0;
    sum += std::min(most, d * d / variance_at(i));
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

double Comparison::variance_at(std::size_t value) const {
  const std::size_t pixel = value / 3, across_pixels = static_cast<std::size_t>(width());
  const std::size_t x = pixel % across_pixels, y = pixel / across_pixels;
  const std::size_t block = y / side * static_cast<std::size_t>(across()) + x / side;
  const double rounding = 0.5 / 255 / (2 * std::max(double{shown_[value]}, 0.06));
  return pixel_variance_[3 * block + value % 3] + rounding * rounding + 1e-5;
}

double Comparison::noise_of(const Image& image) const {
  const std::vector<float> values = shown_of(image);
  return std::sqrt(double{middle_of(variances(values))});
}

}  // namespace photonproof
