#include "harness/metrics/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "harness/metrics/metric_rows.h"
#include "harness/metrics/metric_run.h"

namespace photonproof::inline harness_metrics {
namespace {

using enum BoundKind;

constexpr const char* kBlackReference = "the reference's mean is 0";
constexpr const char* kSmallImage = "a side is under 11 pixels, or the mask has no whole window";
constexpr const char* kFewScales = "a side is under 161 pixels, there is a mask, or structures are opposed in the mean";

double absolute(double value) { return std::abs(value); }
double short_of_one(double value) { return 1 - value; }
double square_of_decibels(double value) { return std::pow(10, -value / 10); }

constexpr TileShares kPixels{nullptr, absolute, false, false};
constexpr TileShares kWindows{nullptr, absolute, false, true};
constexpr TileShares kLikenessOfWindows{nullptr, short_of_one, false, true};
constexpr TileShares kDecibels{nullptr, square_of_decibels, false, false};
constexpr TileShares kGreatestPixel{nullptr, absolute, true, false};
constexpr TileShares kGreatestWindow{nullptr, absolute, true, true};
constexpr TileShares shares_of(const char* metric) { return {metric, nullptr, false, false}; }

constexpr std::array kRows = {
    MetricRow{"mse", maximum, mse_pass, 0, kPixels, nullptr, nullptr},
    MetricRow{"rmse", maximum, mse_pass, 1, shares_of("mse"), nullptr, nullptr},
    MetricRow{"mae", maximum, mae_pass, 0, kPixels, nullptr, nullptr},
    MetricRow{"max_abs", maximum, mae_pass, 1, kGreatestPixel, nullptr, nullptr},
    MetricRow{"bias", absolute_maximum, bias_pass, 0, kPixels, nullptr, kBlackReference},
    MetricRow{"bias_r", absolute_maximum, bias_pass, 1, kPixels, nullptr, kBlackReference},
    MetricRow{"bias_g", absolute_maximum, bias_pass, 2, kPixels, nullptr, kBlackReference},
    MetricRow{"bias_b", absolute_maximum, bias_pass, 3, kPixels, nullptr, kBlackReference},
    MetricRow{"relmse", maximum, relmse_pass, 0, kPixels, relmse_parameters, nullptr},
    MetricRow{"relmse_trimmed", maximum, relmse_pass, 1, shares_of("relmse"), relmse_trimmed_parameters, nullptr},
    MetricRow{"relmse_jeri", maximum, relmse_jeri_pass, 0, kPixels, relmse_jeri_parameters, nullptr},
    MetricRow{"mrse_pbrt", maximum, mrse_pbrt_pass, 0, kPixels, mrse_pbrt_parameters,
              "a value of the reference is -0.01"},
    MetricRow{"smape", maximum, smape_pass, 0, kPixels, smape_parameters, nullptr},
    MetricRow{"psnr", minimum, psnr_pass, 0, kDecibels, psnr_parameters, nullptr},
    MetricRow{"ssim", minimum, ssim_pass, 0, kLikenessOfWindows, ssim_parameters, kSmallImage},
    MetricRow{"ms_ssim", minimum, ssim_pass, 1, shares_of("ssim"), ms_ssim_parameters, kFewScales},
    MetricRow{"flip", maximum, flip_pass, 0, kWindows, flip_parameters, nullptr},
    MetricRow{"flip_weighted_quartile1", maximum, flip_pass, 1, shares_of("flip"), flip_parameters, nullptr},
    MetricRow{"flip_weighted_median", maximum, flip_pass, 2, shares_of("flip"), flip_parameters, nullptr},
    MetricRow{"flip_weighted_quartile3", maximum, flip_pass, 3, shares_of("flip"), flip_parameters, nullptr},
    MetricRow{"flip_max", maximum, flip_pass, 4, kGreatestWindow, flip_parameters, nullptr},
    MetricRow{"hdr_flip", maximum, hdr_flip_pass, 0, kWindows, hdr_flip_parameters,
              "the reference is black, and no exposures are given", true, derive_hdr_exposures},
    MetricRow{"differing", maximum, differing_pass, 0, kPixels, differing_parameters, nullptr, true},
    MetricRow{"differing_pixels", maximum, differing_pass, 1, shares_of("differing"), differing_parameters, nullptr,
              true},
};

/// Checks that every row locates its tiles' error by itself, or by a row that does.
constexpr bool shares_lead_somewhere() {
  return std::ranges::all_of(kRows, [](const MetricRow& row) {
    if (row.shares.by == nullptr) return row.shares.loss != nullptr;
    return std::ranges::any_of(kRows, [&](const MetricRow& other) {
      return std::string_view(other.name) == row.shares.by && other.shares.by == nullptr;
    });
  });
}
static_assert(shares_lead_somewhere());

/// Calls visit(part) for each "name" and "name=value" that the row's number depends on.
template <class Visit>
void for_each_part(const MetricRow& row, const Visit& visit) {
  const std::string text = row.parameters ? row.parameters() : std::string();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(", ", at), text.size());
    visit(text.substr(at, end - at));
    at = end + 2;
  }
}

}  // namespace

std::span<const MetricRow> metric_rows() { return kRows; }

const MetricRow* find_metric(const std::string& name) {
  for (const MetricRow& row : kRows)
    if (name == row.name) return &row;
  return nullptr;
}

bool is_wanted(const MetricRow& row, const MetricOptions& options) {
  const auto named_in = [&](const std::vector<std::string>& names) {
    return std::ranges::find(names, row.name) != names.end();
  };
  return named_in(options.also) || (options.only.empty() ? !row.on_request : named_in(options.only));
}

bool has_parameter(const MetricRow& row, const MetricParameter& parameter) {
  bool found = false;
  for_each_part(row, [&](const std::string& part) { found = found || part == parameter.name; });
  return found;
}

std::string metrics_with(const MetricParameter& parameter) {
  std::string names;
  for (const MetricRow& row : kRows)
    if (has_parameter(row, parameter)) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

std::string parameters_text(const MetricRow& row, const ParameterValues& values) {
  std::string text;
  for_each_part(row, [&](std::string part) {
    if (const auto* parameter = std::ranges::find(metric_parameters, part, &MetricParameter::name);
        parameter != metric_parameters.end()) {
      const std::string value = value_text(*parameter, values);
      if (value.empty()) return;
      part += "=" + value;
    }
    text += (text.empty() ? "" : ", ") + part;
  });
  return text;
}

std::vector<MetricValue> compute_metrics(const Image& reference, const Image& test, const MetricOptions& options) {
  return finite_values(measure(reference, test, options));
}

}  // namespace photonproof::inline harness_metrics
