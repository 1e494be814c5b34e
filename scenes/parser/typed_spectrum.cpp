#include "scenes/parser/typed_spectrum.h"

#include <algorithm>
#include <cmath>

#include "scenes/parser/plugins.h"
#include "scenes/parser/spectrum_value.h"

namespace photonproof::scene_xml {
namespace {

using Samples = std::vector<SpectrumSample>;

/// The numbers of a parameter that is a list.
std::vector<double> list_of(Params& params, const std::string& name) {
  std::vector<double> numbers;
  const std::string text = params.string(name, "");
  for (const std::string_view word : split_list(text)) {
    const auto parsed = parse_number(word);
    if (!parsed.value) params.fail(name, parsed.problem);
    numbers.push_back(*parsed.value);
  }
  params.expect(numbers.size() >= 2, name, "has fewer than two numbers");
  return numbers;
}

Samples regular(Params& params) {
  const double first = params.positive("wavelength_min", 360), last = params.positive("wavelength_max", 830);
  params.expect(first < last, "wavelength_max", "is not above wavelength_min");
  const std::vector<double> values = list_of(params, "values");
  Samples samples;
  for (std::size_t i = 0; i < values.size(); ++i)
    samples.push_back(
        {first + (last - first) * static_cast<double>(i) / static_cast<double>(values.size() - 1), values[i]});
  return samples;
}

Samples irregular(Params& params) {
  const std::vector<double> wavelengths = list_of(params, "wavelengths"), values = list_of(params, "values");
  params.expect(wavelengths.size() == values.size(), "values", "has not one number for each of wavelengths");
  Samples samples;
  for (std::size_t i = 0; i < values.size(); ++i) samples.push_back({wavelengths[i], values[i]});
  return samples;
}

/// Planck's law with the constants of CODATA 2018.
Samples blackbody(Params& params) {
  constexpr double first_constant = 1.191042972397188e-16;  // 2 h c^2, W m^2 sr^-1
  constexpr double second_constant = 1.438776877503933e-2;  // h c / k, m K
  constexpr double nanometre = 1e-9;
  const double temperature = params.positive("temperature", 5000), scale = params.number_in("scale", 1, 0, 1e30);
  Samples samples;
  for (int wavelength = 355; wavelength <= 835; wavelength += 5) {
    const double metres = wavelength * nanometre;
    const double radiance =
        first_constant / (std::pow(metres, 5) * std::expm1(second_constant / (metres * temperature)));
    samples.push_back({static_cast<double>(wavelength), scale * radiance * nanometre});
  }
  return samples;
}

}  // namespace

RgbD typed_spectrum_of(SceneObjects& objects, const Element& element, SpectrumKind kind, double most) {
  const ParamType number = ParamType::number, text = ParamType::string;
  const std::vector<Plugin<RgbD>> table = {
      {"blackbody",
       {{"scale", number}, {"temperature", number}},
       {},
       [&](Params& p) { return rgb_of_samples(p.sources(), element, blackbody(p), kind, most); }},
      {"d65",
       {{"color", ParamType::colour}, {"scale", number}},
       {},
       [](Params& p) { return p.colour("color", RgbD(1.0), 0, 1e30) * p.number_in("scale", 1, 0, 1e30); }},
      {"irregular",
       {{"values", text}, {"wavelengths", text}},
       {},
       [&](Params& p) { return rgb_of_samples(p.sources(), element, irregular(p), kind, most); }},
      {"regular",
       {{"values", text}, {"wavelength_max", number}, {"wavelength_min", number}},
       {},
       [&](Params& p) { return rgb_of_samples(p.sources(), element, regular(p), kind, most); }},
      {"srgb", {{"color", ParamType::colour}}, {}, [](Params& p) { return p.colour("color", RgbD(0.5), 0, 1e30); }},
      {"uniform", {{"value", number}}, {}, [](Params& p) { return RgbD(p.number_in("value", 1, 0, 1e30)); }}};
  return build_plugin(objects, element, table);
}

}  // namespace photonproof::scene_xml
