#include "harness/metrics.h"

#include <array>
#include <cmath>

#include "harness/metric_context.h"
#include "harness/metric_relmse.h"
#include "harness/metric_rows.h"

namespace photonproof {
namespace {

using enum BoundKind;

constexpr const char* kBlackReference = "the reference's mean is 0";
constexpr const char* kSmallImage = "a side is under 11 pixels";

constexpr std::array kRows = {
    MetricRow{"mse", maximum, mse, nullptr, nullptr},
    MetricRow{"rmse", maximum, rmse, nullptr, nullptr},
    MetricRow{"mae", maximum, mae, nullptr, nullptr},
    MetricRow{"max_abs", maximum, max_abs, nullptr, nullptr},
    MetricRow{"bias", absolute_maximum, bias, nullptr, kBlackReference},
    MetricRow{"bias_r", absolute_maximum, bias_r, nullptr, kBlackReference},
    MetricRow{"bias_g", absolute_maximum, bias_g, nullptr, kBlackReference},
    MetricRow{"bias_b", absolute_maximum, bias_b, nullptr, kBlackReference},
    MetricRow{"relmse", maximum, relmse, relmse_parameters, nullptr},
    MetricRow{"relmse_trimmed", maximum, relmse_trimmed, relmse_trimmed_parameters, nullptr},
    MetricRow{"psnr", minimum, psnr, psnr_parameters, nullptr},
    MetricRow{"ssim", minimum, ssim, ssim_parameters, kSmallImage},
    MetricRow{"flip", maximum, flip, flip_parameters, nullptr},
    MetricRow{"flip_weighted_quartile1", maximum, flip_weighted_quartile1, flip_parameters, nullptr},
    MetricRow{"flip_weighted_median", maximum, flip_weighted_median, flip_parameters, nullptr},
    MetricRow{"flip_weighted_quartile3", maximum, flip_weighted_quartile3, flip_parameters, nullptr},
    MetricRow{"flip_max", maximum, flip_max, flip_parameters, nullptr},
};

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

/// Appends the first non-finite value of an image and their number.
void find_non_finite(const Image& image, const std::string& name, std::vector<ImageDefect>& defects) {
  std::size_t first = 0, count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    if (std::isfinite(image.rgb[i])) continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  const std::size_t pixel = first / 3, width = static_cast<std::size_t>(image.width);
  const float value = image.rgb[first];
  const std::string what = std::isnan(value) ? "NaN" : value > 0 ? "+infinity" : "-infinity";
  defects.push_back({ImageDefect::Kind::non_finite, "pixel (" + std::to_string(pixel % width) + ", " +
                                                        std::to_string(pixel / width) + ") of the " + name +
                                                        " image is " + what + " in " + "RGB"[first % 3] + "; " +
                                                        std::to_string(count) + " non-finite in all"});
}

}  // namespace

std::span<const MetricRow> metric_rows() { return kRows; }

const MetricRow* find_metric(const std::string& name) {
  for (const MetricRow& row : kRows)
    if (name == row.name) return &row;
  return nullptr;
}

std::vector<Measurement> measure(const MetricContext& context) {
  std::vector<Measurement> measurements;
  measurements.reserve(kRows.size());
  for (const MetricRow& row : kRows)
    measurements.push_back(
        {&row, row.value(context), row.parameters ? row.parameters(context.options()) : std::string()});
  return measurements;
}

std::vector<ImageDefect> find_defects(const Image& reference, const Image& test) {
  using enum ImageDefect::Kind;
  if (reference.width != test.width || reference.height != test.height)
    return {{size_mismatch,
             "the test image is " + size_text(test) + " pixels, the reference image " + size_text(reference)}};
  if (reference.pixels() == 0) return {{size_mismatch, "the images have no pixels"}};
  std::vector<ImageDefect> defects;
  find_non_finite(reference, "reference", defects);
  find_non_finite(test, "test", defects);
  return defects;
}

std::vector<MetricValue> compute_metrics(const MetricContext& context) {
  std::vector<MetricValue> values;
  for (Measurement& measured : measure(context))
    if (measured.value && std::isfinite(*measured.value))
      values.push_back({measured.row->name, *measured.value, std::move(measured.parameters)});
  return values;
}

std::vector<MetricValue> compute_metrics(const Image& reference, const Image& test, const MetricOptions& options) {
  return compute_metrics(MetricContext(reference, test, options));
}

std::vector<float> flip_map(const Image& reference, const Image& test, const MetricOptions& options) {
  return MetricContext(reference, test, options).flip_map();
}

std::vector<float> relmse_map(const Image& reference, const Image& test) {
  const std::vector<double> errors = relative_squared_errors(reference, test);
  std::vector<float> map(errors.size());
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = static_cast<float>(errors[i]);
  return map;
}

}  // namespace photonproof
