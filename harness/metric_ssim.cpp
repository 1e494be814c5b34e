// Structural similarity (Wang, Bovik, Sheikh, Simoncelli: "Image quality assessment: from error visibility to
// structural similarity", 2004, eq. 13) on display-encoded values, per channel, then the mean of the three. Equal to
// scikit-image's
//   structural_similarity(gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1, channel_axis=2)
// Symbols: mu, var, cov are Gaussian-weighted moments over an 11 x 11 window, C1 = (K1 L)^2, C2 = (K2 L)^2, L = 1.
// Only windows that lie wholly inside the image count, so the treatment of borders does not matter.

#include "harness/metric_filter.h"
#include "harness/metric_rows.h"
#include "harness/metric_sum.h"
#include "scenes/text_numbers.h"

namespace photonproof {
namespace {

constexpr double kSigma = 1.5;
constexpr int kRadius = 5;   // int(3.5 sigma + 0.5): scikit-image's truncation
constexpr int kWindow = 11;  // 2 kRadius + 1
constexpr double kC1 = 0.01 * 0.01;
constexpr double kC2 = 0.03 * 0.03;

/// Gaussian-weighted mean of value(i) over the window at every pixel; i counts pixels.
template <class Value>
Plane window_means(const Image& size, const Value& value) {
  static const Kernel kernel = gaussian_kernel(kSigma, kRadius);
  Plane plane(size.width, size.height);
  for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = value(i);
  return filter_columns(filter_rows(plane, kernel), kernel);
}

double channel_ssim(const MetricContext& context, std::size_t channel) {
  const auto& [encoded_r, encoded_x] = context.encoded();
  const auto r = [&values = encoded_r, channel](std::size_t i) { return values[3 * i + channel]; };
  const auto x = [&values = encoded_x, channel](std::size_t i) { return values[3 * i + channel]; };
  const Image& size = context.reference();
  const Plane mean_r = window_means(size, r);
  const Plane mean_x = window_means(size, x);
  const Plane mean_rr = window_means(size, [&](std::size_t i) { return r(i) * r(i); });
  const Plane mean_xx = window_means(size, [&](std::size_t i) { return x(i) * x(i); });
  const Plane mean_rx = window_means(size, [&](std::size_t i) { return r(i) * x(i); });

  const auto inner_width = static_cast<std::size_t>(size.width) - (kWindow - 1);
  const auto inner_height = static_cast<std::size_t>(size.height) - (kWindow - 1);
  return chunked_mean(inner_width * inner_height, [&](std::size_t inner) {
    const std::size_t y = inner / inner_width + kRadius;
    const std::size_t i = y * static_cast<std::size_t>(size.width) + inner % inner_width + kRadius;
    const double mu_r = mean_r.values[i];
    const double mu_x = mean_x.values[i];
    const double var_r = mean_rr.values[i] - mu_r * mu_r;
    const double var_x = mean_xx.values[i] - mu_x * mu_x;
    const double cov = mean_rx.values[i] - mu_r * mu_x;
    return (2 * mu_r * mu_x + kC1) * (2 * cov + kC2) / ((mu_r * mu_r + mu_x * mu_x + kC1) * (var_r + var_x + kC2));
  });
}

}  // namespace

std::optional<double> ssim(const MetricContext& context) {
  if (context.reference().width < kWindow || context.reference().height < kWindow) return std::nullopt;
  return (channel_ssim(context, 0) + channel_ssim(context, 1) + channel_ssim(context, 2)) / 3;
}

std::string ssim_parameters(const MetricOptions& options) {
  return "exposure=" + format_number(options.exposure) + ", window=11, sigma=1.5, K1=0.01, K2=0.03, data_range=1";
}

}  // namespace photonproof
