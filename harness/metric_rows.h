// The rows metrics.cpp tabulates: what one metric is called, how its bound is meant, and the function that computes it.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "harness/metric_context.h"

namespace photonproof {

/// How a bound on a metric is meant.
enum class BoundKind { maximum, minimum, absolute_maximum };

struct MetricRow {
  const char* name;
  BoundKind bound;
  /// Empty where the metric is undefined; only psnr may be infinite.
  std::optional<double> (*value)(const MetricContext&);
  /// What its number depends on, "name=value, ..."; may be null when there is nothing to say.
  std::string (*parameters)(const MetricOptions&);
  /// When it is undefined, as a clause: "a side is under 11 pixels"; null when it always has a value.
  const char* undefined_when;
};

/// Every metric, in the order of reports.
std::span<const MetricRow> metric_rows();

/// The row of that name, or null.
const MetricRow* find_metric(const std::string& name);

/// Row by row, on one shared context.
struct Measurement {
  const MetricRow* row;
  std::optional<double> value;
  std::string parameters;
};
std::vector<Measurement> measure(const MetricContext& context);

// --- metric_mse.cpp: (x-r)^2 over all channel values --------------------------------------------------------------
std::optional<double> mse(const MetricContext& context);
std::optional<double> rmse(const MetricContext& context);

// --- metric_mae.cpp: |x-r| over all channel values ----------------------------------------------------------------
std::optional<double> mae(const MetricContext& context);
std::optional<double> max_abs(const MetricContext& context);

// --- metric_psnr.cpp: 10 log10(1/mse) of the encoded images; +infinity when they are equal ------------------------
std::optional<double> psnr(const MetricContext& context);
std::string psnr_parameters(const MetricOptions& options);

// --- metric_bias.cpp: mean(x-r)/mean(r); undefined when mean(r) is 0 ----------------------------------------------
std::optional<double> bias(const MetricContext& context);
std::optional<double> bias_r(const MetricContext& context);
std::optional<double> bias_g(const MetricContext& context);
std::optional<double> bias_b(const MetricContext& context);

// --- metric_relmse.cpp ---------------------------------------------------------------------------------------------
std::optional<double> relmse(const MetricContext& context);
std::string relmse_parameters(const MetricOptions& options);
std::optional<double> relmse_trimmed(const MetricContext& context);
std::string relmse_trimmed_parameters(const MetricOptions& options);

// --- metric_ssim.cpp: undefined under 11 x 11 pixels --------------------------------------------------------------
std::optional<double> ssim(const MetricContext& context);
std::string ssim_parameters(const MetricOptions& options);

// --- metric_flip.cpp -----------------------------------------------------------------------------------------------
std::optional<double> flip(const MetricContext& context);
std::optional<double> flip_weighted_quartile1(const MetricContext& context);
std::optional<double> flip_weighted_median(const MetricContext& context);
std::optional<double> flip_weighted_quartile3(const MetricContext& context);
std::optional<double> flip_max(const MetricContext& context);
std::string flip_parameters(const MetricOptions& options);

}  // namespace photonproof
