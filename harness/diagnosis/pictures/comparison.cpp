#include "harness/diagnosis/pictures/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "harness/diagnosis/pictures/difference_band.h"
#include "harness/pixels/middle_of.h"

namespace photonproof::inline harness_diagnosis_pictures {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

Comparison::Comparison(const Image& submitted, std::optional<float> white, double tolerance,
                       std::vector<std::uint8_t> ignored)
    : submitted_(submitted), tolerance_(tolerance), ignored_(std::move(ignored)) {
  float most = 0;
  for (const float v : submitted.rgb)
    if (std::isfinite(v)) most = std::max(most, v);
  white_ = white ? double{*white} : std::max(1.0, double{most});
  shown_ = shown_of(submitted_);
  known_ = without_ignored(shown_);
  countable_.resize(static_cast<std::size_t>(across()) * static_cast<std::size_t>(down()));
  for (std::size_t pixel = 0; pixel < submitted_.pixels(); ++pixel)
    if (counts(pixel)) ++countable_[block_of(pixel)];
  pixel_variance_ = variances(known_);
  noise_ = noise_of(submitted_);
}

double Comparison::shown(double v) const { return std::sqrt(std::clamp(v, 0.0, white_) / white_); }

std::vector<float> Comparison::shown_of(const Image& image) const {
  std::vector<float> values(image.rgb.size());
  const Rows rows = rows_of(image);
  for (int y = 0; y < image.height; ++y)
    rows(y, &values[static_cast<std::size_t>(y) * 3 * static_cast<std::size_t>(image.width)]);
  return values;
}

Comparison::Rows Comparison::rows_of(const Image& guess) const {
  return [this, &guess](int y, float* values) {
    const float* from = guess.pixel(0, y);
    for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(guess.width); ++i)
      values[i] = std::isfinite(from[i]) ? static_cast<float>(shown(from[i])) : unknown;
  };
}

std::vector<float> Comparison::without_ignored(std::vector<float> values) const {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!counts(i / 3)) values[i] = unknown;
  return values;
}

std::vector<float> Comparison::variances(const std::vector<float>& values) const {
  std::vector<float> result(static_cast<std::size_t>(across()) * static_cast<std::size_t>(down()) * 3);
  NeighbourSquares squares(row_values());
  for (int by = 0, block_row = 0; by < height(); by += side, ++block_row) {
    squares.clear();
    for (int y = std::max(0, by - 1); y < std::min(height() - 1, by + side + 1); ++y)
      squares.add(&values[static_cast<std::size_t>(y) * row_values()],
                  &values[static_cast<std::size_t>(y + 1) * row_values()]);
    squares.variances(&result[static_cast<std::size_t>(block_row * across()) * 3]);
  }
  return result;
}

Excess Comparison::excess_by_rows(const Rows& rows, double most) const {
  constexpr double deviations = 3, shared = 2.5;  // noise of photon maps is shared by neighbours
  const std::size_t row = row_values();
  DifferenceBand band(rows, known_, row);
  NeighbourSquares squares(row);
  BlockSums sums(row);
  std::vector<float> apart(static_cast<std::size_t>(across()) * 3);
  Excess result;
  result.block.resize(static_cast<std::size_t>(across()) * static_cast<std::size_t>(down()));
  std::size_t compared = 0, comparable = 0;
  for (int by = 0, block_row = 0; by < height(); by += side, ++block_row) {
    band.hold(std::max(0, by - 1), std::min(height(), by + side + 2));
    squares.clear();
    for (int y = std::max(0, by - 1); y < std::min(height() - 1, by + side + 1); ++y)
      squares.add(band.difference(y), band.difference(y + 1));
    squares.variances(apart.data());
    sums.clear();
    for (int y = by; y < std::min(by + side, height()); ++y) sums.add(band.difference(y), band.expected(y));
    const std::size_t first = static_cast<std::size_t>(block_row * across());
    for (std::size_t i = 0; i < apart.size(); ++i) {
      comparable += countable_[first + i / 3] < 4 ? 0 : 1;
      const BlockSums::Sum sum = sums.of_block(i / 3, i % 3);
      if (sum.count < 4) continue;
      ++compared;
      const double level = sum.expected / sum.count;
      const double variance = std::min(pixel_variance_[3 * first + i], apart[i]);
      const double rounding = 0.5 / 255 / (2 * std::max(level, 0.06));
      const double allowed =
          deviations * std::sqrt(shared * variance / sum.count) + tolerance_ / 2 * level + rounding + 0.004;
      const double over = std::max(0.0, std::abs(sum.difference / sum.count) - allowed);
      result.block[first + i / 3] += over * over;
      result.total += over * over;
    }
    if (result.total > most) return {any, {}};  // the rows below only add to it
  }
  // Unknown blocks of a guess count like the known ones. A guess with hardly any known block explains nothing.
  constexpr double least_known = 0.05;
  if (static_cast<double>(compared) < least_known * static_cast<double>(comparable)) result.total = unexplained;
  if (compared > 0) result.total *= static_cast<double>(3 * result.block.size()) / static_cast<double>(compared);
  if (result.total > most) result.total = any;
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

std::size_t Comparison::block_of(std::size_t pixel) const {
  const auto pixels = static_cast<std::size_t>(width());
  return pixel / pixels / side * static_cast<std::size_t>(across()) + pixel % pixels / side;
}

double Comparison::variance_at(std::size_t value) const {
  const double rounding = 0.5 / 255 / (2 * std::max(double{shown_[value]}, 0.06));
  return pixel_variance_[3 * block_of(value / 3) + value % 3] + rounding * rounding + 1e-5;
}

double Comparison::noise_of(const Image& image) const {
  return std::sqrt(double{middle_of(variances(without_ignored(shown_of(image))))});
}

}  // namespace photonproof::inline harness_diagnosis_pictures
