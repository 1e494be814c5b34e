// Bias of the image by the gathers' radius, learned from the render itself. On a lattice of pixels every gather is made
// twice on the same photons, within r and within r/2. D is the excess of the wide gather. Where irradiance is smooth
// the bias of a gather is b r^2, and D is 3/4 of it in expectation. One disc lies in the other, so the variance of D is
// three times that of L(r), which is c/(n r^2) for n evenly landing photons. Both discs miss details such as the
// contact of a ball with the floor. A narrower disc would see them, but D would be too noisy: at r/3 its variance is
// eight times that of L(r). Measured on `corridor`: .0004 with r/2, .0007 with r/3. Even and odd passes are summed
// apart, since their photons are independent.
//   `mean over pixels of D_even D_odd` is the mean of (3/4 b r^2)^2, without the part that noise would add.
//   `mean over pixels of (D_even - D_odd)^2` is the part that noise adds.
// Both are relative to the image as relmse is. At an edge of light the squared bias, averaged over places, is 4.3 times
// D^2, where smooth light has 16/9. Errors are reported with the larger factor, since edges remain where radii are
// best.
//
// The squared bias is in proportion to a power r^p. Smooth light has p = 4. Edges have p = 1, since a share r of all
// places lies within r of an edge, whatever the height of the edge. With n photons the error is `c/(n r^2) + b r^p`.
//   Its derivative is 0 at `r = (2c / (p b n))^(1/(p+2))`, where the variance V is p/2 times the squared bias B^2.
//   From any other radius, the factor to that one is `(V / (p/2 B^2))^(1/(p+2))`.
//   The least error falls as n^(-p/(p+2)): n^(-2/3) for smooth light and n^(-1/3) at edges.
// A pilot measures p (radius_trials.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/sensor/film.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_photon_mapping {

constexpr double square(double x) { return x * x; }

/// The exponent p of the squared bias in the radius, for smooth light and at edges.
inline constexpr double smooth_exponent = 4, edge_exponent = 1;

/// Numbers of samples and passes in the even and in the odd half of a render.
struct PassHalves {
  std::array<double, 2> samples{};  ///< samples a pixel
  std::array<std::int64_t, 2> passes{};
  std::int64_t pass_count() const { return passes[0] + passes[1]; }
  double all_samples() const { return samples[0] + samples[1]; }
  void add_pass(double pass_samples) {
    const auto half = static_cast<std::size_t>(pass_count() % 2);
    samples[half] += pass_samples;
    passes[half] += 1;
  }
};

class GatherBias {
 public:
  static constexpr int maps = 2, all_maps = -1;
  /// Ratio of the narrow gather's radius to the wide one's.
  static constexpr float narrow_part = 0.5f;

  explicit GatherBias(const Tile& window);

  /// Whether the pixel is on the lattice whose gathers are made twice.
  bool looks_twice(int x, int y) const { return x % stride_ == 0 && y % stride_ == 0; }
  /// Adds the change of the pixel's mean from r to r/2, over a pass of `samples`. One writer a pixel.
  void add(int x, int y, int map, std::int64_t pass, const RgbD& difference, double samples) {
    pixels_[index(x, y)].sum[static_cast<std::size_t>(map)][pass % 2] += difference * samples;
  }

  /// Means over pixels and channels of x^2 / (image^2 + 0.01), where x belongs to the mean over all passes.
  struct Evidence {
    double difference = 0;  ///< square of D's expectation
    double variance = 0;    ///< variance of D
    /// Squared bias of the image by the radius, in units of relmse.
    double squared_bias() const { return 4.3 * std::max(0.0, difference); }
    /// Ratio V / (p/2 B^2) of the variance V and the squared bias B^2 of L(r), for the exponent p; 1 at the best
    /// radius. B^2 / D^2 is interpolated between smooth light and edges.
    double balance(double exponent) const;
    /// Factor from the radius to the best one: the root of order p + 2 of the balance.
    double step(double exponent) const;
  };
  /// Zero before both halves have a pass.
  Evidence evidence(const Film& film, int map, const PassHalves& halves) const;

  /// Factor of the map's radius for gathers of the pixel: 1, or less where the radius is plainly too wide.
  float narrowing(int x, int y, int map) const;
  /// Chooses these factors for the next pass. In blocks of the lattice whose bias exceeds their noise, radii shrink
  /// until it no longer does.
  void narrow(const Film& film, const PassHalves& halves);
  /// Sets the exponent of a map's squared bias, for `narrow`; smooth light's before.
  void set_exponent(int map, double exponent) { exponents_[static_cast<std::size_t>(map)] = exponent; }

  /// For checkpoints: the chosen factors.
  std::vector<float>& narrowings() { return narrowings_; }
  /// For checkpoints: sums of whole tiles.
  struct Pixel {
    std::array<std::array<RgbD, 2>, maps> sum{{{RgbD(0.0), RgbD(0.0)}, {RgbD(0.0), RgbD(0.0)}}};
  };
  std::vector<Pixel>& pixels() { return pixels_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y / stride_ - first_y_) * static_cast<std::size_t>(across_) +
           static_cast<std::size_t>(x / stride_ - first_x_);
  }

  static constexpr int block = 8;  ///< pixels of the lattice a side of a block
  Evidence of_pixel(const Film& film, int x, int y, int map, const PassHalves& halves) const;
  std::size_t block_index(int across, int down, int map) const {
    return static_cast<std::size_t>((map * blocks_down_ + down) * blocks_across_ + across);
  }

  Tile window_;
  int stride_, first_x_, first_y_, across_, down_, blocks_across_, blocks_down_;
  std::vector<Pixel> pixels_;
  std::vector<float> narrowings_;  ///< factors of the blocks, map after map
  std::array<double, maps> exponents_{smooth_exponent, smooth_exponent};
};

/// Radii of one map from pass to pass. A pass of n photons and s of all S samples adds (s/S)^2 c/(n r^2) to the
/// variance of the mean. All passes together are worth N = S^2 / sum(s^2/n) photons of one pass. The relmse c/(N r^2) +
/// b r^p is least where V = c/(N r^2) is p/2 times the squared bias.
struct RadiusHistory {
  double samples = 0;
  double samples_times_square = 0;              ///< Sum of s r^2.
  double squared_samples_over_photons = 0;      ///< Sum of s^2 / n.
  double squared_samples_over_photons_r_2 = 0;  ///< Sum of s^2 / (n r^2).
  double first_radius = 0;                      ///< Guessed radius of the first pass.
  double first_photons = 0;                     ///< Photons of the first pass.
  float radius = 0;                             ///< Radius of the next pass.

  void add_pass(double pass_samples, double photons);
  /// N as defined above.
  double worth() const { return samples * samples / squared_samples_over_photons; }
  /// Best radius for a render that will have so many samples, with photons as up to now, for a squared bias of this
  /// exponent.
  double best(const GatherBias::Evidence& evidence, double all_samples, double exponent = smooth_exponent) const;
};

}  // namespace photonproof::inline renderer_photon_mapping
