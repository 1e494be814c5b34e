// What a user may set of metrics. A parameter is a member of ParameterValues and its row; which metrics have it, they
// say themselves, by naming it in what is printed with their numbers (MetricRow::parameters). All else goes by these
// two: `compare`'s options and their help, the keys of a [[gate]], what accepted verdicts are kept by, and the table of
// suites/FORMAT.md, which suite_format_test.cpp prints.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/images/exposure_range.h"

namespace photonproof::inline harness_metrics {

struct ParameterValues {
  /// Stops applied before the display encoding of psnr, ssim and flip (scale by 2^exposure, clamp to [0,1], sRGB).
  double exposure = 0;
  std::optional<ExposureRange> hdr_exposures{};  ///< of hdr_flip; empty: from the reference, as the paper does
};

/// From `least` to `most`.
struct NumberParameter {
  double ParameterValues::*member;
  double least, most;
};

/// Three numbers: start, stop and count, as expected_exposures says.
struct RangeParameter {
  std::optional<ExposureRange> ParameterValues::*member;
};

struct MetricParameter {
  const char* name;      ///< key of a [[gate]], and what is printed; as an option of `compare` with - for _
  const char* argument;  ///< what its option takes, by name or unit
  const char* meaning;   ///< a clause
  const char* without;   ///< what is done without it, as a clause; null: its member's first value holds
  const char* in_gates;  ///< whose value holds for a gate that does not give it; null: as in `compare`
  const char* example;   ///< another value than it has without being given, as in TOML
  std::variant<NumberParameter, RangeParameter> value;
};

inline constexpr std::array metric_parameters = {
    MetricParameter{.name = "exposure",
                    .argument = "STOPS",
                    .meaning = "stops applied before psnr, ssim and flip encode for display",
                    .without = nullptr,
                    .in_gates = "the scene's",
                    .example = "1.5",
                    .value = NumberParameter{&ParameterValues::exposure, -64, 64}},
    MetricParameter{.name = "exposures",
                    .argument = "START STOP COUNT",
                    .meaning = "first and last exposure of hdr_flip in stops and their number, pinned for a scene",
                    .without = "they are derived from the reference",
                    .in_gates = "the scene's `hdr_flip_exposures`",
                    .example = "[-2, 1, 4]",
                    .value = RangeParameter{&ParameterValues::hdr_exposures}},
};

namespace parameter_count {
struct Anything {
  template <class T>
  operator T() const;
};
template <std::size_t... I>
consteval bool takes(std::index_sequence<I...>) {
  return requires { ParameterValues{(static_cast<void>(I), Anything{})...}; };
}
constexpr std::size_t rows = metric_parameters.size();
static_assert(takes(std::make_index_sequence<rows>{}) && !takes(std::make_index_sequence<rows + 1>{}),
              "every member of ParameterValues has a row of metric_parameters, or nobody can set it");
}  // namespace parameter_count

/// How many numbers it takes: 1 or 3.
std::size_t number_count(const MetricParameter& parameter);

/// "-64 to 64"; empty where that is not all there is to say.
std::string range_text(const MetricParameter& parameter);

/// Its numbers with spaces between, "-2 1 4"; empty where there are none.
std::string value_text(const MetricParameter& parameter, const ParameterValues& values);

/// Every parameter that has a value, "exposure=1, exposures=-2 1 4".
std::string values_text(const ParameterValues& values);

/// Sets it. Of numbers it cannot take it says what is wrong, and sets nothing.
[[nodiscard]] std::optional<std::string> set_parameter(const MetricParameter& parameter,
                                                       std::span<const double> numbers, ParameterValues& values);

/// A value that somebody gave. Precondition: set_parameter takes the numbers.
struct GivenParameter {
  const MetricParameter* parameter;
  std::vector<double> numbers;
};

/// "exposure=1.5"
std::string given_text(const std::vector<GivenParameter>& given);

/// `values` but for those that are given.
ParameterValues with_given(ParameterValues values, const std::vector<GivenParameter>& given);

}  // namespace photonproof::inline harness_metrics
