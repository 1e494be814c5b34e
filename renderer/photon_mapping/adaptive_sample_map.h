// Camera samples per pixel: pixels whose passes disagree most for their brightness get more (a light seen in glass,
// rims, half-shadows). For a given total, an error of s_p/sqrt(n_p) a pixel is least where n_p is in proportion to s_p.
// The sample counts of a pass follow from the passes before it. A pass weighs in its pixel by its own length, whatever
// the count was. A pixel's mean is therefore the mean of estimates that are each unbiased given the past, so it stays
// unbiased. Cross-fitting with halves is similar, but it divides the evidence.
// Rare light in mirrors and glass, such as a light after some reflections inside, may be missed by all passes so far. A
// pilot may supply the variance that it causes (camera_pilot.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_photon_mapping {

class AdaptiveSampleMap {
 public:
  static constexpr std::uint32_t most = 63;

  explicit AdaptiveSampleMap(const Tile& window)
      : window_(window),
        pixels_(static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height())),
        extra_(pixels_.size()) {}

  /// Extra samples of the pixel in the next pass, for each of the pass's own samples.
  std::uint32_t extra(int x, int y) const { return extra_[index(x, y)]; }
  /// Adds a pass's estimate of the pixel from so many camera samples. One writer a pixel.
  void add(int x, int y, const RgbD& mean, double samples) {
    Pixel& p = pixels_[index(x, y)];
    const double value = (mean.x + mean.y + mean.z) / 3;
    p.samples += samples;
    p.sum += samples * value;
    p.squares += samples * value * value;
    p.passes += 1;
  }
  /// Sets a lower bound of the variance of one camera sample, whatever the passes measure. One writer a pixel.
  void set_pilot(int x, int y, double variance) { pixels_[index(x, y)].pilot_variance = variance; }
  /// Chooses the sample counts of the next pass.
  void choose();

  struct Pixel {
    double samples = 0, sum = 0, squares = 0, passes = 0, pilot_variance = 0;
  };
  /// For checkpoints: sums of whole tiles.
  std::vector<Pixel>& pixels() { return pixels_; }
  /// For checkpoints: the chosen sample counts.
  std::vector<std::uint8_t>& decided() { return extra_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - window_.y0) * static_cast<std::size_t>(window_.width()) +
           static_cast<std::size_t>(x - window_.x0);
  }

  Tile window_;
  std::vector<Pixel> pixels_;
  std::vector<std::uint8_t> extra_;
};

}  // namespace photonproof::inline renderer_photon_mapping
