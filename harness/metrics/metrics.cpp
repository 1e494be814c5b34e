#include "harness/metrics/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/metrics/metric_rows.h"
#include "harness/metrics/metric_run.h"

namespace photonproof {
namespace {

using enum BoundKind;

constexpr const char* kBlackReference = "the reference's mean is 0";
constexpr const char* kSmallImage = "a side is under 11 pixels, or the mask has no whole window";
constexpr const char* kFewScales = "a side is under 161 pixels, there is a mask, or structures are opposed in the mean";

constexpr std::array kRows = {
    MetricRow{"mse", maximum, mse_pass, 0, nullptr, nullptr},
    MetricRow{"rmse", maximum, mse_pass, 1, nullptr, nullptr},
    MetricRow{"mae", maximum, mae_pass, 0, nullptr, nullptr},
    MetricRow{"max_abs", maximum, mae_pass, 1, nullptr, nullptr},
    MetricRow{"bias", absolute_maximum, bias_pass, 0, nullptr, kBlackReference},
    MetricRow{"bias_r", absolute_maximum, bias_pass, 1, nullptr, kBlackReference},
    MetricRow{"bias_g", absolute_maximum, bias_pass, 2, nullptr, kBlackReference},
    MetricRow{"bias_b", absolute_maximum, bias_pass, 3, nullptr, kBlackReference},
    MetricRow{"relmse", maximum, relmse_pass, 0, relmse_parameters, nullptr},
    MetricRow{"relmse_trimmed", maximum, relmse_pass, 1, relmse_trimmed_parameters, nullptr},
    MetricRow{"relmse_jeri", maximum, relmse_jeri_pass, 0, relmse_jeri_parameters, nullptr},
    MetricRow{"mrse_pbrt", maximum, mrse_pbrt_pass, 0, mrse_pbrt_parameters, "a value of the reference is -0.01"},
    MetricRow{"smape", maximum, smape_pass, 0, smape_parameters, nullptr},
    MetricRow{"psnr", minimum, psnr_pass, 0, psnr_parameters, nullptr},
    MetricRow{"ssim", minimum, ssim_pass, 0, ssim_parameters, kSmallImage},
    MetricRow{"ms_ssim", minimum, ssim_pass, 1, ms_ssim_parameters, kFewScales},
    MetricRow{"flip", maximum, flip_pass, 0, flip_parameters, nullptr},
    MetricRow{"flip_weighted_quartile1", maximum, flip_pass, 1, flip_parameters, nullptr},
    MetricRow{"flip_weighted_median", maximum, flip_pass, 2, flip_parameters, nullptr},
    MetricRow{"flip_weighted_quartile3", maximum, flip_pass, 3, flip_parameters, nullptr},
    MetricRow{"flip_max", maximum, flip_pass, 4, flip_parameters, nullptr},
    MetricRow{"hdr_flip", maximum, hdr_flip_pass, 0, hdr_flip_parameters,
              "the reference is black in the median, and no exposures are given", true},
};

}  // namespace

std::span<const MetricRow> metric_rows() { return kRows; }

const MetricRow* find_metric(const std::string& name) {
  for (const MetricRow& row : kRows)
    if (name == row.name) return &row;
  return nullptr;
}

std::vector<MetricValue> compute_metrics(const Image& reference, const Image& test, const MetricOptions& options) {
  return finite_values(measure(reference, test, options));
}

}  // namespace photonproof
