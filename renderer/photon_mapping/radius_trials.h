// Errors of gather radii, tried on a pilot's photons (radius_pilot.h), and the best radius for any number of photons.
// With more photons than the pilot's, smaller biases decide than its photons can show. The squared bias then follows a
// power r^p (gather_bias.h), whose exponent is that of the narrowest radii with a plain bias. The least error is in
// proportion to n^(-p/(p+2)). The radius beyond the pilot follows smooth light, as n^(-1/6), until passes show the
// bias. Edges' n^(-1/3) has more noise at first: on `water-caustic` with 4 samples a pixel the error is 9 % larger.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "renderer/photon_mapping/gather_bias.h"

namespace photonproof::inline renderer_photon_mapping {

class RadiusTrials {
 public:
  RadiusTrials() = default;
  /// `emitted` is the number of light paths of the pilot, `least_exponent` the lower limit of `exponent`.
  explicit RadiusTrials(double emitted, double least_exponent = edge_exponent)
      : emitted_(emitted), least_exponent_(least_exponent) {}

  /// Variance of L(r) with the pilot's photons and its squared bias, in units of relmse.
  struct Error {
    double variance, squared_bias;
  };
  /// In ascending order of the radius. Doubt is a squared bias that the photons could not show. The radius is chosen by
  /// `by_groups`, where light and its surroundings are as bright; `by_neighbours` tells the error where they are not.
  void add(double radius, const Error& by_groups, double doubt, const Error& by_neighbours) {
    trials_.push_back({radius, by_groups.variance, by_groups.squared_bias, doubt, by_neighbours});
  }
  void add(double radius, double variance, double squared_bias, double doubt) {
    add(radius, {variance, squared_bias}, doubt, {variance, squared_bias});
  }
  bool empty() const { return trials_.empty(); }
  /// The exponent p of the squared bias, between the limit and that of smooth light. Smooth light's where too few
  /// trials show a bias plainly.
  double exponent() const { return std::max(least_exponent_, seen_exponent().value_or(smooth_exponent)); }
  /// The radius for photons of so many light paths. Among radii of nearly the least error, doubt included, it is the
  /// least, since wide gathers take more time. With more photons than the pilot's it is in proportion to n^(-1/6).
  /// There must be a trial.
  double best(double emitted) const;
  /// Expected variance plus squared bias of that radius. At the best radius the squared bias is 2/p of the variance, or
  /// more if more is seen. Beyond the pilot it falls by the exponent that is seen, whatever the limit of `exponent`, or
  /// by a middle one where none is.
  double error(double emitted) const;

 private:
  struct Trial {
    double radius, variance, squared_bias, doubt;
    Error by_neighbours;
  };
  /// With photons of so many light paths. Variance is in inverse proportion to them; bias does not depend on them.
  double variance(const Trial& trial, double emitted) const { return trial.variance * emitted_ / emitted; }
  double at_most(const Trial& trial, double emitted) const {
    return variance(trial, emitted) + trial.squared_bias + trial.doubt;
  }
  const Trial& chosen(double emitted) const;
  /// Without the limit of `exponent`; absent where too few trials show a bias plainly.
  std::optional<double> seen_exponent() const;

  double emitted_ = 1, least_exponent_ = smooth_exponent;
  std::vector<Trial> trials_;
};

}  // namespace photonproof::inline renderer_photon_mapping
