// relmse = mean of (x-r)^2/(r^2+epsilon), epsilon = 0.01, as tev and SimpleImageIO define it (Rousselle, Knaus,
// Zwicker: "Adaptive sampling and reconstruction using greedy error minimization", 2011). relmse_trimmed leaves out the
// floor(pixels/1000) pixels of greatest error, which on caustics are a few fireflies. SimpleImageIO's newer releases
// rank channel values where we rank pixels; its older ones rank pixels too.

#include "harness/metric_relmse.h"

#include <algorithm>

#include "harness/metric_rows.h"
#include "harness/metric_sum.h"

namespace photonproof {
namespace {

constexpr double kEpsilon = 0.01;
constexpr std::size_t kOnePixelIn = 1000;

}  // namespace

std::vector<double> relative_squared_errors(const Image& reference, const Image& test) {
  std::vector<double> errors(reference.pixels());
  for (std::size_t p = 0; p < errors.size(); ++p) {
    double sum = 0;
    for (std::size_t i = 3 * p; i < 3 * p + 3; ++i) {
      const double r = static_cast<double>(reference.rgb[i]);
      const double difference = static_cast<double>(test.rgb[i]) - r;
      sum += difference * difference / (r * r + kEpsilon);
    }
    errors[p] = sum / 3;
  }
  return errors;
}

std::optional<double> relmse(const MetricContext& context) {
  const auto& errors = context.relative_errors();
  return chunked_mean(errors.size(), [&](std::size_t i) { return errors[i]; });
}

std::string relmse_parameters(const MetricOptions&) { return "epsilon=0.01"; }

std::optional<double> relmse_trimmed(const MetricContext& context) {
  const auto& errors = context.relative_errors();
  const std::size_t kept = errors.size() - errors.size() / kOnePixelIn;
  std::vector<double> ranked = errors;
  const auto last_kept = ranked.begin() + static_cast<std::ptrdiff_t>(kept - 1);
  std::nth_element(ranked.begin(), last_kept, ranked.end());
  const double threshold = *last_kept;
  // Summed in pixel order, not in the order the ranking left, so that no library's algorithm decides the last bits.
  std::size_t below = 0;
  const double sum_below = chunked_sum(errors.size(), [&](std::size_t i) {
    if (errors[i] >= threshold) return 0.0;
    ++below;
    return errors[i];
  });
  return (sum_below + static_cast<double>(kept - below) * threshold) / static_cast<double>(kept);
}

std::string relmse_trimmed_parameters(const MetricOptions&) { return "epsilon=0.01, trimmed=0.1% of pixels"; }

}  // namespace photonproof
