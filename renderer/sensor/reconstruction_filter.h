// Reconstruction filters as densities: camera samples are drawn from them (kernels/camera_rays.h), and splats of light
// paths are spread by them. With negative lobes: the cubics of Mitchell and Netravali 1988 (that of Catmull and Rom is
// one of them), and windowed sincs (Lanczos).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/sensor/camera_view.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_sensor {

/// The filter that spreads light paths. With one narrower than `narrowest_splat` almost none of the arriving paths
/// would count, each for as much more.
ReconstructionFilter filter_of_splats(ReconstructionFilter filter);
inline constexpr double narrowest_splat = 0.5;  ///< radius, pixels

constexpr bool has_negative_lobes(ReconstructionFilter::Kind kind) {
  using Kind = ReconstructionFilter::Kind;
  return kind != Kind::box && kind != Kind::tent && kind != Kind::gaussian;
}

FilterView compile_filter(const ReconstructionFilter& filter, bool sample_border);

/// The filter's value along an axis, whose integral is 1.
class FilterKernel {
 public:
  explicit FilterKernel(const ReconstructionFilter& filter);

  double radius() const { return radius_; }
  double operator()(double distance) const;
  /// Number of pixels that share a splat: 1 / (integral of the filter's square)^2.
  double pixels_a_splat() const;
  /// Integral from 0 to `distance`, at most 1/2.
  double half_integral(double distance) const;
  /// Integrals of the values above and below 0 from 0 to `distance`, both not negative.
  struct Lobes {
    double positive = 0, negative = 0;
  };
  Lobes half_lobes(double distance) const;
  /// Integral over the film's `size` around the middle of its pixel `at` along an axis.
  double integral_within(int at, int size) const;

  /// Calls visit(x, y, weight) for the pixels of a width x height image that a sample at `raster` reaches. The weights
  /// are the filter at the pixels' middles: around an interior point they sum to 1 in the mean over its places.
  template <class Visit>
  void for_each_pixel(const Vec2<float>& raster, int width, int height, Visit&& visit) const {
    const auto first = [&](float at) { return std::max(static_cast<int>(std::ceil(double{at} - 0.5 - radius_)), 0); };
    const auto last = [&](float at, int size) {
      return std::min(static_cast<int>(std::floor(double{at} - 0.5 + radius_)), size - 1);
    };
    for (int y = first(raster.y); y <= last(raster.y, height); ++y) {
      const double weight_y = (*this)(double{raster.y} - 0.5 - y);
      for (int x = first(raster.x); x <= last(raster.x, width); ++x) {
        const double weight = weight_y * (*this)(double{raster.x} - 0.5 - x);
        if (weight != 0) visit(x, y, static_cast<float>(weight));
      }
    }
  }

 private:
  /// The filters with negative lobes, up to a factor.
  double lobed(double x) const;
  void integrate_lobes();

  ReconstructionFilter::Kind kind_;
  double radius_ = 0.5;
  double stddev_ = 1, floor_ = 0;   ///< of the Gaussian; its value at the radius is subtracted
  double b_ = 0, c_ = 0;            ///< of the cubics
  double tau_ = 1;                  ///< of the windowed sincs
  std::vector<Lobes> lobes_up_to_;  ///< half_lobes at even steps to the radius, before normalisation
  double inverse_integral_ = 1;
};

}  // namespace photonproof::inline renderer_sensor
