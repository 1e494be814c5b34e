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

/// Mitchell and Netravali 1988, equation 8, for x >= 0; 0 from x = 2 on.
double cubic(double x, double b, double c) {
  if (x >= 2) return 0;
  if (x < 1) return (((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x + (6 - 2 * b)) / 6;
  return (((-b - 6 * c) * x + (6 * b + 30 * c)) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
}

double sinc(double x) {
  const double angle = std::numbers::pi * x;
  return angle < 1e-5 ? 1 : std::sin(angle) / angle;
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
    case ReconstructionFilter::Kind::mitchell:
      b_ = filter.b;
      c_ = filter.c;
      radius_ = filter.mitchell_radius.value_or(2);
      break;
    case ReconstructionFilter::Kind::catmullrom:
      c_ = 0.5;
      radius_ = 2;
      break;
    case ReconstructionFilter::Kind::lanczos:
      radius_ = tau_ = filter.lobes;
      break;
    case ReconstructionFilter::Kind::sinc:
      radius_ = filter.sinc_radius;
      tau_ = filter.tau;
      break;
  }
  if (has_negative_lobes(kind_)) integrate_lobes();
}

double FilterKernel::lobed(double x) const {
  const bool is_cubic =
      kind_ == ReconstructionFilter::Kind::mitchell || kind_ == ReconstructionFilter::Kind::catmullrom;
  if (x >= radius_) return 0;
  return is_cubic ? cubic(2 * x / radius_, b_, c_) : sinc(x) * sinc(x / tau_);
}

void FilterKernel::integrate_lobes() {
  constexpr int steps = 16384, parts = 2;
  const double width = radius_ / (steps * parts);
  Lobes sum;
  lobes_up_to_.assign(1, sum);
  for (int i = 0; i < steps * parts; ++i) {
    const double value = lobed((i + 0.5) * width);
    (value > 0 ? sum.positive : sum.negative) += std::abs(value) * width;
    if ((i + 1) % parts == 0) lobes_up_to_.push_back(sum);
  }
  inverse_integral_ = 0.5 / (sum.positive - sum.negative);
}

FilterKernel::Lobes FilterKernel::half_lobes(double distance) const {
  if (lobes_up_to_.empty()) return {half_integral(distance), 0};
  const auto steps = static_cast<double>(lobes_up_to_.size() - 1);
  const double at = std::clamp(distance / radius_, 0.0, 1.0) * steps;
  const auto below = static_cast<std::size_t>(std::min(at, steps - 1));
  const double part = at - static_cast<double>(below);
  const Lobes &low = lobes_up_to_[below], &high = lobes_up_to_[below + 1];
  const auto between = [&](double a, double b) { return (a + (b - a) * part) * inverse_integral_; };
  return {between(low.positive, high.positive), between(low.negative, high.negative)};
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
    default:
      return lobed(x) * inverse_integral_;
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
    default: {
      const Lobes lobes = half_lobes(x);
      return lobes.positive - lobes.negative;
    }
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

namespace {

void set_lobes(const FilterKernel& kernel, bool sample_border, FilterView& view) {
  const FilterKernel::Lobes all = kernel.half_lobes(kernel.radius());
  view.has_lobes = true;
  view.negative_integral = static_cast<float>(2 * all.negative);
  const auto share = [](double part, double whole) { return whole > 0 ? static_cast<float>(part / whole) : 1.0f; };
  for (std::uint32_t cell = 0; cell <= FilterView::cells; ++cell) {
    const FilterKernel::Lobes up_to = kernel.half_lobes(kernel.radius() * cell / FilterView::cells);
    view.lobes[cell] = share(up_to.positive, all.positive);
    view.lobes[FilterView::cells + 1 + cell] = share(up_to.negative, all.negative);
  }
  if (sample_border) return;
  // As AxisLobes::offset (camera_ray.h) interpolates, so that no sample falls beyond a border.
  const auto share_within = [&](std::uint32_t table, double distance) {
    const double at = std::min(distance / kernel.radius(), 1.0) * FilterView::cells;
    const std::uint32_t cell = std::min(static_cast<std::uint32_t>(at), FilterView::cells - 1);
    const double low = double{view.lobes[table + cell]}, high = double{view.lobes[table + cell + 1]};
    return low + (high - low) * (at - cell);
  };
  for (std::uint32_t pixel = 0; pixel <= FilterView::widest; ++pixel)
    for (const std::uint32_t sign : {0u, 1u})
      view.lobes_beyond_border[sign * (FilterView::widest + 1) + pixel] =
          static_cast<float>((1 - share_within(sign * (FilterView::cells + 1), pixel + 0.5)) / 2);
}

}  // namespace

FilterView compile_filter(const ReconstructionFilter& filter, bool sample_border) {
  const FilterKernel kernel(filter);
  FilterView view;
  view.is_box = filter.kind == ReconstructionFilter::Kind::box;
  view.radius = static_cast<float>(kernel.radius());
  if (sample_border) view.margin = static_cast<float>(FilterKernel(filter_of_splats(filter)).radius() - 0.5);
  if (has_negative_lobes(filter.kind)) {
    set_lobes(kernel, sample_border, view);
    return view;
  }
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
