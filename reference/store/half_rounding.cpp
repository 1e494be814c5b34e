#include "reference/store/half_rounding.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scenes/base/splitmix.h"

namespace photonproof::inline reference_store {
namespace {

// Below 2^-14 halves are 2^-24 apart, above by the exponent; the spacing is a power of two, so that dividing is exact.
float spacing_at(float x) {
  constexpr int least_exponent = -14, fraction_bits = 10;
  const int exponent = x == 0 ? least_exponent : std::max(std::ilogb(x), least_exponent);
  return std::ldexp(1.0f, exponent - fraction_bits);
}

// In [0, 1), of the index alone.
double uniform_of(std::uint64_t index) { return static_cast<double>(splitmix64(0, index + 1) >> 11) * 0x1p-53; }

// To 11 significant bits.
float short_variance(double v) {
  const auto value = static_cast<float>(v);
  constexpr std::uint32_t dropped = 23 - 10;
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value) + (1u << (dropped - 1));
  const auto rounded = std::bit_cast<float>(bits >> dropped << dropped);
  return std::isfinite(rounded) ? rounded : value;
}

}  // namespace

double most_rounding_variance(double x) { return std::ldexp(x * x, -22); }

float half_below(float x) { return std::floor(x / spacing_at(x)) * spacing_at(x); }
float half_above(float x) { return std::ceil(x / spacing_at(x)) * spacing_at(x); }

Rendering rounded_to_halves(const Rendering& rendering) {
  Rendering rounded = rendering;
  for (std::size_t i = 0; i < rendering.mean.rgb.size(); ++i) {
    const float x = rendering.mean.rgb[i], below = half_below(x), above = half_above(x);
    const double down = double{x} - below, up = double{above} - x;
    rounded.mean.rgb[i] = uniform_of(i) * (down + up) < down ? above : below;
    rounded.variance->rgb[i] = short_variance(double{rendering.variance->rgb[i]} + down * up);
  }
  return rounded;
}

void widen_to_half_rounding(Rendering& rounded) {
  for (std::size_t i = 0; i < rounded.mean.rgb.size(); ++i) {
    const auto most = static_cast<float>(most_rounding_variance(double{rounded.mean.rgb[i]}));
    rounded.variance->rgb[i] = std::max(rounded.variance->rgb[i], most);
  }
}

}  // namespace photonproof::inline reference_store
