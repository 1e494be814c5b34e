// What the radius of gathers does to the image, learned from the render itself. On a lattice of pixels every gather
// is made twice on the same photons, within r and within r/2; D is what the wide one brings more. Where irradiance is
// smooth the bias of a gather is b r^2, so that D is 3/4 of it in expectation; and since one disc lies in the other,
// the variance of D is three times that of L(r), which is c/(n r^2) for n photons, where photons land evenly. (A
// narrower disc would see finer shades, such as where a ball touches the floor, which both discs miss alike; but of its
// variance, eight times that of L(r) at r/3, too little would be known. Measured: corridor .0004 with r/2, .0007 with
// r/3.) Even and odd passes are summed apart: their photons are independent, so that
//   mean over pixels of D_even D_odd        is the mean of (3/4 b r^2)^2, without what noise would add, and
//   mean over pixels of (D_even - D_odd)^2  is what noise adds.
// Both are relative to the image as relmse is. At an edge of light the square of the bias, averaged over places, is 4.3
// times D's and not 16/9 times: so much is claimed, since edges are what is left where radii are best.
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

/// The even and the odd passes of a render.
struct PassHalves {
  std::array<double, 2> samples{};  ///< a pixel
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
  /// The narrow gather's part of the radius.
  static constexpr float narrow_part = 0.5f;

  explicit GatherBias(const Tile& window);

  /// Whether gathers of the pixel are made twice.
  bool looks_twice(int x, int y) const { return x % stride_ == 0 && y % stride_ == 0; }
  /// Adds what the pixel's mean over a pass of `samples` loses from r to r/2. One writer a pixel.
  void add(int x, int y, int map, std::int64_t pass, const RgbD& difference, double samples) {
    pixels_[index(x, y)].sum[static_cast<std::size_t>(map)][pass % 2] += difference * samples;
  }

  /// Of the mean over all passes: means over pixels and channels of x^2 / (image^2 + 0.01).
  struct Evidence {
    double difference = 0;  ///< the square of what is expected of D
    double variance = 0;    ///< of D
    /// Of the image by the radius, as relmse counts it.
    double squared_bias() const { return 4.3 * std::max(0.0, difference); }
    /// (V / 2B^2) for the variance V and the smooth bias B of L(r): 1 where the radius is right, and the sixth power of
    /// what it should be multiplied by.
    double balance() const { return variance / 3 / (2 * square(4.0 / 3) * difference); }
  };
  /// Nothing before both halves have a pass.
  Evidence evidence(const Film& film, int map, const PassHalves& halves) const;

  /// Part of the map's radius that gathers of the pixel take: 1, or less where the radius is plainly too wide.
  float narrowing(int x, int y, int map) const;
  /// Decides that for the next pass: in blocks of the lattice whose bias stands out from their noise radii shrink,
  /// until it does not.
  void narrow(const Film& film, const PassHalves& halves);

  /// For checkpoints: what was decided.
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

  static constexpr int block = 8;  ///< pixels of the lattice a side
  Evidence of_pixel(const Film& film, int x, int y, int map, const PassHalves& halves) const;
  std::size_t block_index(int across, int down, int map) const {
    return static_cast<std::size_t>((map * blocks_down_ + down) * blocks_across_ + across);
  }

  Tile window_;
  int stride_, first_x_, first_y_, across_, down_, blocks_across_, blocks_down_;
  std::vector<Pixel> pixels_;
  std::vector<float> narrowings_;  ///< of the blocks, map after map
};

/// The radius of one map from pass to pass. A pass of n photons and s of all S samples brings (s/S)^2 c/(n r^2) to the
/// variance of the mean, so that all are worth S^2 / sum(s^2/n) = N photons of one pass. relmse is c/(N r^2) + b^2 r^4,
/// least where V = c/(N r^2) is twice B^2.
struct RadiusHistory {
  double samples = 0;
  double samples_times_square = 0;              ///< sum of s r^2
  double squared_samples_over_photons = 0;      ///< sum of s^2 / n
  double squared_samples_over_photons_r_2 = 0;  ///< sum of s^2 / (n r^2)
  double first_radius = 0;                      ///< guessed, for the first pass
  double first_photons = 0;                     ///< of that pass
  float radius = 0;                             ///< of the next pass

  void add_pass(double pass_samples, double photons);
  /// N of above.
  double worth() const { return samples * samples / squared_samples_over_photons; }
  /// For a render that will have so many samples, with photons as up to now.
  double best(const GatherBias::Evidence& evidence, double all_samples) const;
};

}  // namespace photonproof::inline renderer_photon_mapping
