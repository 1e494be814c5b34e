// Errors of gather radii, tried on a pilot's photons (radius_pilot.h), and the best radius for any number of photons.
#pragma once

#include <vector>

namespace photonproof::inline renderer_photon_mapping {

class RadiusTrials {
 public:
  RadiusTrials() = default;
  /// `emitted` is the number of light paths of the pilot.
  explicit RadiusTrials(double emitted) : emitted_(emitted) {}

  /// In ascending order of the radius. The variance of L(r) with the pilot's photons, its squared bias, and a bias that
  /// the photons could not show; in units of relmse.
  void add(double radius, double variance, double squared_bias, double doubt) {
    trials_.push_back({radius, variance, squared_bias, doubt});
  }
  bool empty() const { return trials_.empty(); }

  /// The radius for photons of so many light paths. Among radii of nearly the least error, doubt included, it is the
  /// least, since wide gathers take more time. With more photons than the pilot's, smaller biases decide than its
  /// photons can show: the radius then is in proportion to n^(-1/6). There must be a trial.
  double best(double emitted) const;
  /// Expected variance plus squared bias of that radius, which is in proportion to n^(-2/3) for more photons. At the
  /// best radius the squared bias is half of the variance (gather_bias.h), or more if more is seen.
  double error(double emitted) const;

 private:
  struct Trial {
    double radius, variance, squared_bias, doubt;
  };
  /// With photons of so many light paths. Variance is in inverse proportion to them; bias does not depend on them.
  double variance(const Trial& trial, double emitted) const { return trial.variance * emitted_ / emitted; }
  double at_most(const Trial& trial, double emitted) const {
    return variance(trial, emitted) + trial.squared_bias + trial.doubt;
  }
  const Trial& chosen(double emitted) const;

  double emitted_ = 1;
  std::vector<Trial> trials_;
};

}  // namespace photonproof::inline renderer_photon_mapping
