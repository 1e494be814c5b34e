// The rows metrics.cpp tabulates: what one metric is called, how its bound is meant, and what computes it.
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

/// How a bound on a metric is meant.
enum class BoundKind { maximum, minimum, absolute_maximum };

/// How the tiles of an image share its error, for largest_error_shares (statistics/error_shares.h). Nothing here is
/// left out: a row without it does not compile.
struct TileShares {
  const char* by;                ///< the other metric whose tiles tell it, as mse's tell rmse; null: its own
  double (*loss)(double value);  ///< what a tile's value is short of a perfect one; null where another's tiles tell it
  bool greatest;                 ///< the greatest counts, alone: the losses of tiles are no parts of a sum over pixels
  bool windows;                  ///< pixels around a tile count for it
};

struct MetricRow {
  const char* name;
  BoundKind bound;
  /// Makes what gathers the number. Rows that name the same maker share one pass; `which` is their own number in it.
  std::unique_ptr<MetricPass> (*pass)(const PairFacts&);
  std::size_t which;
  TileShares shares;
  /// What its number depends on, "name=value, name, ...": a name alone is one of metric_parameters, which this metric
  /// thereby has and whose value stands there in print. Null when there is nothing to say.
  std::string (*parameters)();
  /// When it is undefined, as a clause: "a side is under 11 pixels"; null when it always has a value.
  const char* undefined_when;
  /// Computed only when MetricOptions name it.
  bool on_request = false;
  /// Gives the parameters that nobody gave what the reference has for them; may be null.
  void (*derive)(ParameterValues&, RowSource& reference) = nullptr;
};

/// Every metric, in the order of reports.
std::span<const MetricRow> metric_rows();

/// The row of that name, or null.
const MetricRow* find_metric(const std::string& name);

/// Whether the options ask for it: by its name, or by naming none where it is not on request.
bool is_wanted(const MetricRow& row, const MetricOptions& options);

/// Whether its number depends on it.
bool has_parameter(const MetricRow& row, const MetricParameter& parameter);

/// The names of all that have it, "psnr, ssim".
std::string metrics_with(const MetricParameter& parameter);

/// What the row's number depends on, with the values of its parameters; a parameter without a value is left out.
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

// --- metric_bias.cpp: mean(x-r)/mean(r); 0 overall, 1 to 3 of R, G, B; undefined when mean(r) is 0 -------------------
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

// --- metric_hdr_flip.cpp ---------------------------------------------------------------------------------------------
std::unique_ptr<MetricPass> hdr_flip_pass(const PairFacts& pair);
std::string hdr_flip_parameters();
void derive_hdr_exposures(ParameterValues& values, RowSource& reference);

}  // namespace photonproof::inline harness_metrics
