// Parameters of metrics that a user may set. A parameter is a member of ParameterValues and its row. The metrics that
// have it name it in the text printed with their numbers (MetricRow::parameters). Everything else follows from these
// two: `compare`'s options and their help, the keys of a [[gate]], the keys of accepted verdicts. The table of
// docs/formats/suite.md, which suite_format_test.cpp prints, does so, too.
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
  std::optional<ExposureRange> hdr_exposures{};  ///< Exposures of hdr_flip; empty: from the reference, as in the paper.
  double more_than = 0.004;  ///< Displayed difference, of 1 for white, from which a pixel counts as differing.
};

/// A number from `least` to `most`.
struct NumberParameter {
  double ParameterValues::*member;
  double least, most;
};

/// Three numbers: start, stop and count, as in expected_exposures.
struct RangeParameter {
  std::optional<ExposureRange> ParameterValues::*member;
};

struct MetricParameter {
  const char* name;      ///< Key of a [[gate]] and printed name; `compare`'s option has - for _.
  const char* argument;  ///< The argument of its option, by name or unit.
  const char* meaning;   ///< The meaning as a clause.
  const char* without;   ///< The behaviour without it, as a clause; null: its member's initial value holds.
  const char* in_gates;  ///< The source of the value in a gate without it; null: as in `compare`.
  const char* example;   ///< A value other than the default, as in TOML.
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
    MetricParameter{.name = "more_than",
                    .argument = "DIFFERENCE",
                    .meaning = "displayed difference that a pixel may have before it counts; 1/255 is 0.00392",
                    .without = nullptr,
                    .in_gates = nullptr,
                    .example = "0.02",
                    .value = NumberParameter{&ParameterValues::more_than, 0, 1}},
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

/// The count of its numbers: 1 or 3.
std::size_t number_count(const MetricParameter& parameter);

/// "-64 to 64"; empty where a range does not describe it.
std::string range_text(const MetricParameter& parameter);

/// Its numbers with spaces between, "-2 1 4"; empty without a value.
std::string value_text(const MetricParameter& parameter, const ParameterValues& values);

/// Every parameter that has a value, "exposure=1, exposures=-2 1 4".
std::string values_text(const ParameterValues& values);

/// Sets the parameter. For invalid numbers it returns the reason and sets nothing.
[[nodiscard]] std::optional<std::string> set_parameter(const MetricParameter& parameter,
                                                       std::span<const double> numbers, ParameterValues& values);

/// A value set by a user. Precondition: set_parameter accepts the numbers.
struct GivenParameter {
  const MetricParameter* parameter;
  std::vector<double> numbers;
};

/// "exposure=1.5"
std::string given_text(const std::vector<GivenParameter>& given);

/// `values` with the given parameters replaced.
ParameterValues with_given(ParameterValues values, const std::vector<GivenParameter>& given);

}  // namespace photonproof::inline harness_metrics
