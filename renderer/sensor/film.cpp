#include "renderer/sensor/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/core/checkpoint.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline renderer_sensor {

Film::Film(const Tile& window)
    : window_(window), pixels_(static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height())) {}

namespace {

/// Never below zero in spite of rounding; NaN stays NaN.
RgbD variance_of_mean(const RgbD& spread, std::int64_t estimates) {
  const auto component = [&](double v) { return std::max(v / static_cast<double>(estimates - 1), 0.0); };
  return {component(spread.x), component(spread.y), component(spread.z)};
}

}  // namespace

void Film::separate(const NegativeLobes& lobes) {
  negative_.assign(pixels_.size(), Pixel());
  subtracted_.clear();
  for (int y = window_.y0; y < window_.y1; ++y)
    for (int x = window_.x0; x < window_.x1; ++x) subtracted_.push_back(lobes.subtracted(x, y));
}

RgbD Film::mean(std::size_t pixel) const {
  const RgbD positive = pixels_[pixel].mean();
  if (negative_.empty()) return positive;
  return positive * (1 + subtracted_[pixel]) - negative_[pixel].mean() * subtracted_[pixel];
}

RgbD Film::variance(std::size_t pixel) const {
  const Pixel& p = pixels_[pixel];
  const RgbD positive = variance_of_mean(p.spread(), p.estimates);
  if (negative_.empty()) return positive;
  const Pixel& n = negative_[pixel];
  const double m = subtracted_[pixel];
  return positive * ((1 + m) * (1 + m)) + variance_of_mean(n.spread(), n.estimates) * (m * m);
}

void Film::end_shared_pass(double samples) {
  Pixel now;
  for (const Pixel& p : pixels_) {
    now.sum += p.sum;
    now.weight += p.weight;
  }
  const double weight = now.weight - before_pass_.weight;
  if (weight != samples * static_cast<double>(pixels_.size())) return;
  const RgbD mean = (now.sum - before_pass_.sum) / weight;
  before_pass_ = now;
  passes_.sum += mean * samples;
  passes_.sum_of_squares += mean * mean * samples;
  passes_.weight += samples;
  passes_.estimates += 1;
}

Rendering Film::develop() const {
  Rendering rendering;
  rendering.mean = Image(width(), height());
  bool any_variance = variance_in_float().fits;
  for (std::size_t i = 0; i < pixels_.size(); ++i) any_variance = any_variance && has_variance(i);
  if (any_variance) rendering.variance = Image(width(), height());
  const auto store = [](float* out, const RgbD& v) {
    out[0] = static_cast<float>(v.x);
    out[1] = static_cast<float>(v.y);
    out[2] = static_cast<float>(v.z);
  };
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (pixels_[i].weight == 0) continue;
    store(&rendering.mean.rgb[3 * i], mean(i));
    if (any_variance) store(&rendering.variance->rgb[3 * i], variance(i));
  }
  if (passes_.estimates >= 2) {
    const RgbD mean = passes_.sum / passes_.weight;
    const RgbD v = variance_of_mean(passes_.sum_of_squares / passes_.weight - mean * mean, passes_.estimates);
    store_mean_error(rendering,
                     {{std::sqrt(v.x), std::sqrt(v.y), std::sqrt(v.z)}, static_cast<double>(passes_.estimates)});
  }
  if (pixels_a_splat_ > 1) store_pixels_a_splat(rendering, pixels_a_splat_);
  return rendering;
}

VarianceInFloat Film::variance_in_float() const {
  constexpr double of_rounding = 1e-10;  // of the mean squared: less may be no noise at all
  constexpr double most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::min();
  VarianceInFloat in_float;
  double largest = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (!has_variance(i)) continue;
    const RgbD of_pixel = variance(i), positive = pixels_[i].mean(), spread = pixels_[i].spread();
    const auto is_lost = [&](double v, double of, double m) {
      return v > most || (v < least && of > of_rounding * m * m);
    };
    largest = std::max({largest, of_pixel.x, of_pixel.y, of_pixel.z});
    if (is_lost(of_pixel.x, spread.x, positive.x) || is_lost(of_pixel.y, spread.y, positive.y) ||
        is_lost(of_pixel.z, spread.z, positive.z))
      ++in_float.lost;
  }
  in_float.fits = in_float.lost == 0 || (largest <= most && largest >= least);
  return in_float;
}

std::optional<double> Film::relative_standard_error(double epsilon) const {
  RgbD sum(0.0);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (!has_variance(i)) return std::nullopt;
    const RgbD of_pixel = variance(i), of_mean = mean(i);
    const RgbD scale = of_mean * of_mean + RgbD(epsilon);
    sum += RgbD(of_pixel.x / scale.x, of_pixel.y / scale.y, of_pixel.z / scale.z);
  }
  return std::sqrt((sum.x + sum.y + sum.z) / (3 * static_cast<double>(pixels_.size())));
}

double Film::mean_square() const {
  RgbD sum(0.0);
  for (std::size_t i = 0; i < pixels_.size(); ++i) sum += mean(i) * mean(i);
  return (sum.x + sum.y + sum.z) / (3 * static_cast<double>(pixels_.size()));
}

std::size_t Film::unsampled_pixels() const {
  return static_cast<std::size_t>(
      std::count_if(pixels_.begin(), pixels_.end(), [](const Pixel& p) { return p.estimates == 0; }));
}

void Film::save(StateWriter& out) const {
  out.value(window_);
  out.vector(pixels_);
  if (!negative_.empty()) out.vector(negative_);
  out.value(passes_);
  out.value(before_pass_);
}

void Film::restore(StateReader& in) {
  if (in.value<Tile>() != window_) in.refuse("it is of another part of the image");
  in.vector(pixels_);
  if (!negative_.empty()) in.vector(negative_);
  passes_ = in.value<Pixel>();
  before_pass_ = in.value<Pixel>();
}

}  // namespace photonproof::inline renderer_sensor
