#include "renderer/sensor/reconstruction_filter.h"

#include <iterator>
#include <numbers>

#include "scenes/base/faults.h"

namespace photonproof::inline renderer_sensor {
namespace {

/// The share of samples of filter_offset (camera_ray.h) that are farther than this on one side.
double share_beyond(const FilterView& view, double distance) {
  const auto above = std::upper_bound(view.quantiles.begin(), view.quantiles.end(), static_cast<float>(distance));
  if (above == view.quantiles.end()) return 0;
  const double low = double{*(above - 1)}, high = double{*above};
  const double at = static_cast<double>(above - 1 - view.quantiles.begin()) + (distance - low) / (high - low);
  return std::pow(1 - at / FilterView::steps, 2) / 2;
}

}  // namespace

ReconstructionFilter filter_of_splats(ReconstructionFilter filter) {
  filter.radius = std::max(filter.radius, narrowest_splat);
  filter.stddev = std::max(filter.stddev, narrowest_splat / 4);
  return filter;
}

FilterKernel::FilterKernel(const ReconstructionFilter& filter) : kind_(filter.kind) {
  switch (kind_) {
    case ReconstructionFilter::Kind::box:
      radius_ = 0.5;
      break;
    case ReconstructionFilter::Kind::tent:
      radius_ = filter.radius;
      inverse_integral_ = 1 / radius_;
      break;
    case ReconstructionFilter::Kind::gaussian:
      stddev_ = filter.stddev;
      radius_ = 4 * stddev_;
      floor_ = std::exp(-8.0);  // at 4 deviations
      inverse_integral_ = 1.0;
      inverse_integral_ = 0.5 / half_integral(radius_);
      break;
  }
}

double FilterKernel::operator()(double distance) const {
  const double x = std::abs(distance);
  switch (kind_) {
    case ReconstructionFilter::Kind::box:
      // Half open, so that a point belongs to one pixel.
      return distance >= -0.5 && distance < 0.5 ? 1 : 0;
    case ReconstructionFilter::Kind::tent:
      return std::max(0.0, 1 - x / radius_) * inverse_integral_;
    case ReconstructionFilter::Kind::gaussian:
      break;
  }
  return x < radius_ ? std::max(0.0, std::exp(-x * x / (2 * stddev_ * stddev_)) - floor_) * inverse_integral_ : 0;
}

double FilterKernel::half_integral(double distance) const {
  const double x = std::clamp(distance, 0.0, radius_);
  switch (kind_) {
    case ReconstructionFilter::Kind::box:
      return x;
    case ReconstructionFilter::Kind::tent:
      return (x - x * x / (2 * radius_)) * inverse_integral_;
    case ReconstructionFilter::Kind::gaussian:
      break;
  }
  return (stddev_ * std::sqrt(std::numbers::pi / 2) * std::erf(x / (stddev_ * std::numbers::sqrt2)) - floor_ * x) *
         inverse_integral_;
}

double FilterKernel::pixels_a_splat() const {
  constexpr int steps = 512;
  double squares = 0;
  for (int i = 0; i < steps; ++i) squares += std::pow((*this)(radius_ * (2 * (i + 0.5) / steps - 1)), 2);
  return std::pow(steps / (2 * radius_ * squares), 2);
}

double FilterKernel::integral_within(int at, int size) const {
  const double before = at + 0.5, after = size - before;
  if (std::min(before, after) >= radius_) return 1;
  return half_integral(before) + half_integral(after);
}

FilterView compile_filter(const ReconstructionFilter& filter, bool sample_border) {
  const FilterKernel kernel(filter);
  FilterView view;
  view.is_box = filter.kind == ReconstructionFilter::Kind::box;
  view.radius = static_cast<float>(kernel.radius());
  if (sample_border) view.margin = static_cast<float>(FilterKernel(filter_of_splats(filter)).radius() - 0.5);
  for (std::uint32_t i = 0; i <= FilterView::steps; ++i) {
    const double left = 1 - i / double{FilterView::steps}, share = 1 - left * left;
    double low = 0, high = kernel.radius();
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      (2 * kernel.half_integral(middle) < share ? low : high) = middle;
    }
    view.quantiles[i] = static_cast<float>(has_fault(Fault::wide_filter) ? 1.2 * high : high);
  }
  if (!sample_border)
    for (std::uint32_t pixel = 0; pixel < FilterView::widest; ++pixel)
      view.beyond_border[pixel] = static_cast<float>(share_beyond(view, pixel + 0.5));
  return view;
}

}  // namespace photonproof::inline renderer_sensor
