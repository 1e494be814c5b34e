#include "harness/metrics/metric_parameters.h"

#include <algorithm>
#include <cmath>

#include "scenes/base/text_numbers.h"

namespace photonproof::inline harness_metrics {
namespace {

std::vector<double> numbers_of(const MetricParameter& parameter, const ParameterValues& values) {
  if (const auto* number = std::get_if<NumberParameter>(&parameter.value)) return {values.*number->member};
  const auto& range = values.*std::get<RangeParameter>(parameter.value).member;
  if (!range) return {};
  return {range->start, range->stop, static_cast<double>(range->count)};
}

std::string text_of(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + format_number(number);
  return text;
}

std::optional<std::string> set_number(const NumberParameter& parameter, const std::string& limits, double number,
                                      ParameterValues& values) {
  if (!(number >= parameter.least && number <= parameter.most)) return format_number(number) + " is not from " + limits;
  values.*parameter.member = number;
  return std::nullopt;
}

std::optional<std::string> set_range(const RangeParameter& parameter, std::span<const double> numbers,
                                     ParameterValues& values) {
  const double count = numbers[2];
  if (count != std::floor(count)) return "the count " + format_number(count) + " is not a whole number";
  const ExposureRange range{numbers[0], numbers[1], static_cast<int>(std::clamp(count, 0.0, 1e6))};
  if (!is_usable(range)) return expected_exposures;
  values.*parameter.member = range;
  return std::nullopt;
}

}  // namespace

std::size_t number_count(const MetricParameter& parameter) {
  return std::holds_alternative<NumberParameter>(parameter.value) ? 1 : 3;
}

std::string range_text(const MetricParameter& parameter) {
  const auto* number = std::get_if<NumberParameter>(&parameter.value);
  return number ? format_number(number->least) + " to " + format_number(number->most) : std::string();
}

std::string value_text(const MetricParameter& parameter, const ParameterValues& values) {
  return text_of(numbers_of(parameter, values));
}

std::string values_text(const ParameterValues& values) {
  std::vector<GivenParameter> all;
  for (const MetricParameter& parameter : metric_parameters)
    if (std::vector<double> numbers = numbers_of(parameter, values); !numbers.empty())
      all.push_back({&parameter, std::move(numbers)});
  return given_text(all);
}

std::string given_text(const std::vector<GivenParameter>& given) {
  std::string text;
  for (const auto& [parameter, numbers] : given)
    text += (text.empty() ? "" : ", ") + std::string(parameter->name) + "=" + text_of(numbers);
  return text;
}

std::optional<std::string> set_parameter(const MetricParameter& parameter, std::span<const double> numbers,
                                         ParameterValues& values) {
  if (const std::size_t count = number_count(parameter); numbers.size() != count)
    return count == 1 ? "expected a number" : expected_exposures;
  if (const auto* number = std::get_if<NumberParameter>(&parameter.value))
    return set_number(*number, range_text(parameter), numbers[0], values);
  return set_range(std::get<RangeParameter>(parameter.value), numbers, values);
}

ParameterValues with_given(ParameterValues values, const std::vector<GivenParameter>& given) {
  for (const auto& [parameter, numbers] : given) static_cast<void>(set_parameter(*parameter, numbers, values));
  return values;
}

}  // namespace photonproof::inline harness_metrics
