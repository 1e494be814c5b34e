#include "harness/verify/stale_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/pixels/image_blocks.h"
#include "harness/verify/picture_pair.h"
#include "scenes/base/percent_text.h"

namespace photonproof::inline harness_verify {
namespace {

/// Squares of the residual over their variances, for a block and channel, after dividing by the block's own factor.
struct Residual {
  double squares = 0, values = 0;
};

Residual residual_of(const Deviations& d, const Block& block, std::size_t channel) {
  double expected = 0, seen = 0;
  const auto at = [&](int x, int y) -> const Deviation& {
    return d
        .pixels[channel][static_cast<std::size_t>(y) * static_cast<std::size_t>(d.width) + static_cast<std::size_t>(x)];
  };
  for_each_pixel(block, [&](int x, int y) {
    expected += at(x, y).expected;
    seen += at(x, y).expected + at(x, y).difference;
  });
  if (expected <= 0 || seen <= 0) return {};
  const double factor = seen / expected;
  Residual residual;
  for_each_pixel(block, [&](int x, int y) {
    const Deviation& pixel = at(x, y);
    const double left = pixel.expected * (1 - factor) + pixel.difference;
    const double noise = std::pow(pixel.standard_error, 2);
    if (noise <= 0) return;
    residual.squares += std::min(left * left / noise, 100.0);  // limits the weight of one firefly
    residual.values += 1;
  });
  residual.values = std::max(0.0, residual.values - 1);
  return residual;
}

}  // namespace

ReferenceState state_of_reference(const EnginePicture& reference, const EnginePicture& right) {
  const Deviations d = deviations_between(right, reference);
  const BlockScore excess_of = block_excess(d, pair_alpha, both_declare(right, reference));
  double squares = 0, values = 0, brighter = 0, darker = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t b = 0; b < d.places.size(); ++b) {
      const Residual residual = residual_of(d, d.places[b], c);
      squares += residual.squares;
      values += residual.values;
      (d.blocks[c][b].difference > 0 ? brighter : darker) += excess_of(b, c);
    }
  double shift = 0, expected = 0;
  for (const Deviation& whole : d.whole) {
    shift += whole.difference;
    expected += whole.expected;
  }
  const double noise = values > 0 ? std::sqrt(squares / values) : 1;
  const double one_side = std::max(brighter, darker) / std::max(1e-9, brighter + darker);
  ReferenceState state;
  constexpr double usual_noise = 1.5, most = 0.9;
  state.is_stale = noise < usual_noise && (brighter + darker == 0 || one_side >= most);
  const std::string differs = expected != 0
                                  ? "differs by " + signed_percent_text(shift / expected) + " from the engines' mean"
                                  : "differs from the engines' black image";
  state.sentence =
      state.is_stale ? fmt::format(
                           "stale reference: it {}, in one direction and with its own noise; "
                           "the scene or the renderer has changed since, render it again",
                           differs)
      : noise >= usual_noise
          ? fmt::format("damaged reference: its pixels scatter {:.2g} times as much as its variance states", noise)
          : fmt::format("the stored reference {} overall, and in both directions: it is of another image", differs);
  return state;
}

}  // namespace photonproof::inline harness_verify
