#include "renderer/sensor/reconstruction_filter.h"

#include <numbers>

#include "scenes/text/faults.h"

namespace photonproof {

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

FilterView compile_filter(const ReconstructionFilter& filter) {
  const FilterKernel kernel(filter);
  FilterView view;
  view.is_box = filter.kind == ReconstructionFilter::Kind::box;
  view.radius = static_cast<float>(kernel.radius());
  view.splat_radius = static_cast<float>(FilterKernel(filter_of_splats(filter)).radius());
  for (std::uint32_t i = 0; i <= FilterView::steps; ++i) {
    const double left = 1 - i / double{FilterView::steps}, share = 1 - left * left;
    double low = 0, high = kernel.radius();
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      (2 * kernel.half_integral(middle) < share ? low : high) = middle;
    }
    view.quantiles[i] = static_cast<float>(has_fault(Fault::wide_filter) ? 1.2 * high : high);
  }
  return view;
}

}  // namespace photonproof
