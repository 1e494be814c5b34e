// The rows of the table in metrics.cpp: a metric's name, the meaning of its bound, and its computation.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "harness/metrics/metric_pass.h"

namespace photonproof::inline harness_pixels {
class RowSource;
}

namespace photonproof::inline harness_metrics {

/// The meaning of a bound on a metric.
enum class BoundKind { maximum, minimum, absolute_maximum };

/// The shares of an image's tiles in its error, for largest_error_shares (statistics/error_shares.h). All members are
/// required: a row without one does not compile.
struct TileShares {
  const char* by;                ///< The other metric whose tiles locate this error, such as mse for rmse; null: its
                                 ///< own.
  double (*loss)(double value);  ///< The shortfall of a tile's value from a perfect one; null with `by`.
  bool greatest;                 ///< Only the greatest tile counts: losses of tiles are no parts of a sum over pixels.
  bool windows;                  ///< Pixels around a tile count for it.
};

struct MetricRow {
  const char* name;
  BoundKind bound;
  /// Makes the pass that computes the number. Rows with the same maker share one pass; `which` is their number in it.
  std::unique_ptr<MetricPass> (*pass)(const PairFacts&);
  std::size_t which;
  TileShares shares;
  /// The dependencies of its number, "name=value, name, ...". A name alone is one of metric_parameters: the metric has
  /// this parameter, and its value is printed there. Null without any.
  std::string (*parameters)();
  /// The condition under which it is undefined, as a clause: "a side is under 11 pixels"; null when it always has a
  /// value.
  const char* undefined_when;
  /// Computed only when MetricOptions name it.
  bool on_request = false;
  /// Sets parameters without a given value from the reference; may be null.
  void (*derive)(ParameterValues&, RowSource& reference) = nullptr;
};

/// Every metric, in the order of reports.
std::span<const MetricRow> metric_rows();

/// The row of that name, or null.
const MetricRow* find_metric(const std::string& name);

/// Whether the options include it: by its name, or by naming none where it is not on request.
bool is_wanted(const MetricRow& row, const MetricOptions& options);

/// Whether its number depends on the parameter.
bool has_parameter(const MetricRow& row, const MetricParameter& parameter);

/// The names of all metrics with the parameter, "psnr, ssim".
std::string metrics_with(const MetricParameter& parameter);

/// The dependencies of the row's number, with the values of its parameters; those without a value are left out.
std::string parameters_text(const MetricRow& row, const ParameterValues& values);

/// An empty value is undefined; only psnr may be infinite.
struct Measurement {
  const MetricRow* row;
  std::optional<double> value;
  std::string parameters;
};

// --- metric_mse.cpp: (x-r)^2 over all channel values; 0 its mean, 1 the root of it -----------------------------------
std::unique_ptr<MetricPass> mse_pass(const PairFacts& pair);

// --- metric_mae.cpp: |x-r| over all channel values; 0 the mean, 1 the greatest ---------------------------------------
std::unique_ptr<MetricPass> mae_pass(const PairFacts& pair);

// --- metric_bias.cpp: mean(x-r)/mean(r), undefined when mean(r) is 0; 0 overall, 1 to 3 of R, G, B -------------------
std::unique_ptr<MetricPass> bias_pass(const PairFacts& pair);

// --- metric_relmse.cpp: 0 the mean, 1 the trimmed one ----------------------------------------------------------------
std::unique_ptr<MetricPass> relmse_pass(const PairFacts& pair);
std::string relmse_parameters();
std::string relmse_trimmed_parameters();

// --- metric_relmse_jeri.cpp, metric_mrse_pbrt.cpp, metric_smape.cpp --------------------------------------------------
std::unique_ptr<MetricPass> relmse_jeri_pass(const PairFacts& pair);
std::string relmse_jeri_parameters();
std::unique_ptr<MetricPass> mrse_pbrt_pass(const PairFacts& pair);
std::string mrse_pbrt_parameters();
std::unique_ptr<MetricPass> smape_pass(const PairFacts& pair);
std::string smape_parameters();

// --- metric_psnr.cpp: 10 log10(1/mse) of the encoded images; +infinity when they are equal ---------------------------
std::unique_ptr<MetricPass> psnr_pass(const PairFacts& pair);
std::string psnr_parameters();

// --- metric_ssim.cpp: 0 ssim, 1 ms_ssim (metric_ms_ssim.cpp), whose first scale it is --------------------------------
std::unique_ptr<MetricPass> ssim_pass(const PairFacts& pair);
std::string ssim_parameters();
std::string ms_ssim_parameters();

// --- metric_flip.cpp: 0 the mean, 1 to 3 the weighted quartiles, 4 the greatest --------------------------------------
std::unique_ptr<MetricPass> flip_pass(const PairFacts& pair);
std::string flip_parameters();

// --- metric_differing.cpp: 0 the share of pixels, 1 their number -----------------------------------------------------
std::unique_ptr<MetricPass> differing_pass(const PairFacts& pair);
std::string differing_parameters();

// --- metric_hdr_flip.cpp ---------------------------------------------------------------------------------------------
std::unique_ptr<MetricPass> hdr_flip_pass(const PairFacts& pair);
std::string hdr_flip_parameters();
void derive_hdr_exposures(ParameterValues& values, RowSource& reference);

}  // namespace photonproof::inline harness_metrics
