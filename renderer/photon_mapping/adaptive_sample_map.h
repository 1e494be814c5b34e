// Which pixels get more camera samples than others: those whose passes disagree most for their brightness (a light seen
// in glass, rims, half-shadows). An error of s_p/sqrt(n_p) a pixel is least, for so many samples in all, where n_p goes
// with s_p. The numbers of a pass follow from the passes before it, and a pass weighs in its pixel by its own length
// whatever the number was: so the mean of a pixel is that of estimates each of which is unbiased given the past, and
// stays unbiased (as with the halves of cross-fitting, but without dividing the evidence).
// What mirrors and glass show now and then, a light after some reflections inside, no pass may have met yet: a pilot
// may say the variance that it brings (camera_pilot.h).
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

  /// Samples that the pixel gets in the next pass beyond each of the pass's own.
  std::uint32_t extra(int x, int y) const { return extra_[index(x, y)]; }
  /// A pass's estimate of the pixel, of so many camera samples. One writer a pixel.
  void add(int x, int y, const RgbD& mean, double samples) {
    Pixel& p = pixels_[index(x, y)];
    const double value = (mean.x + mean.y + mean.z) / 3;
    p.samples += samples;
    p.sum += samples * value;
    p.squares += samples * value * value;
    p.passes += 1;
  }
  /// At least so much is the variance of one camera sample, whatever passes see of it. One writer a pixel.
  void set_pilot(int x, int y, double variance) { pixels_[index(x, y)].pilot_variance = variance; }
  /// Decides for the next pass.
  void choose();

  struct Pixel {
    double samples = 0, sum = 0, squares = 0, passes = 0, pilot_variance = 0;
  };
  /// For checkpoints: sums of whole tiles.
  std::vector<Pixel>& pixels() { return pixels_; }
  /// For checkpoints: what was decided.
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
