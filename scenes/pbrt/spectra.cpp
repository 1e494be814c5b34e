#include "scenes/pbrt/spectra.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "scenes/base/text_numbers.h"
#include "scenes/description/named_ior.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_pbrt {
namespace {

double luminance(const RgbD& c) { return 0.212671 * c.x + 0.715160 * c.y + 0.072169 * c.z; }

/// Linear Rec. 709 of linear colours of other spaces with the white D65 (ITU-R BT.2087, SMPTE EG 432-1).
RgbD in_rec709(const RgbD& c, PbrtColours space) {
  RgbD result = c;
  if (space == PbrtColours::rec2020)
    result = {1.660491 * c.x - 0.587641 * c.y - 0.072850 * c.z, -0.124550 * c.x + 1.132900 * c.y - 0.008349 * c.z,
              -0.018151 * c.x - 0.100579 * c.y + 1.118730 * c.z};
  if (space == PbrtColours::dci_p3)
    result = {1.224940 * c.x - 0.224940 * c.y, -0.042057 * c.x + 1.042057 * c.y,
              -0.019638 * c.x - 0.078636 * c.y + 1.098274 * c.z};
  return {std::max(0.0, result.x), std::max(0.0, result.y), std::max(0.0, result.z)};
}

/// Planck's law up to a factor.
std::vector<SpectrumSample> blackbody(double kelvin) {
  std::vector<SpectrumSample> samples;
  constexpr double c2 = 1.438776877e7;  // nm K
  for (int nm = 360; nm <= 830; nm += 5) {
    const double wavelength = nm;
    const double peak = std::pow(wavelength / 555, -5);
    samples.push_back({wavelength, peak * std::expm1(c2 / (555 * kelvin)) / std::expm1(c2 / (wavelength * kelvin))});
  }
  return samples;
}

/// Indices at 587.6 nm of the glasses that pbrt names.
const std::map<std::string, double>& glasses() {
  static const std::map<std::string, double> table = {
      {"glass-BK7", 1.5168},  {"glass-BAF10", 1.6700}, {"glass-FK51A", 1.4866}, {"glass-LASF9", 1.8503},
      {"glass-F5", 1.6034},   {"glass-F10", 1.6228},   {"glass-F11", 1.6206},   {"glass-SF5", 1.6727},
      {"glass-SF10", 1.7283}, {"glass-SF11", 1.7847}};
  return table;
}

}  // namespace

RgbD PbrtSpectra::rgb(const PbrtParameters& parameters, const PbrtParameter& value) const {
  if (value.numbers.size() != 3) parameters.fail(value, "expected three numbers");
  const RgbD c(value.numbers[0], value.numbers[1], value.numbers[2]);
  if (c.x < 0 || c.y < 0 || c.z < 0) parameters.fail(value, "is negative, expected at least 0");
  return in_rec709(c, value.colours);
}

std::vector<SpectrumSample> PbrtSpectra::samples(const PbrtParameters& parameters, const PbrtParameter& value) const {
  std::vector<double> numbers = value.numbers;
  if (!value.strings.empty()) {
    const std::string text = read_file(files_.find(value.strings[0], value.at), std::size_t{1} << 24);
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const std::string line = text.substr(at, end - at);
      for (const std::string_view word : split_list(std::string_view(line).substr(0, line.find('#')))) {
        const Parsed<double> number = parse_number(word);
        if (!number.value) parameters.fail(value, "names a file of a spectrum that " + number.problem);
        numbers.push_back(*number.value);
      }
      at = end + 1;
    }
  }
  std::vector<SpectrumSample> samples;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) samples.push_back({numbers[i], numbers[i + 1]});
  const auto before = [](const SpectrumSample& a, const SpectrumSample& b) { return a.wavelength < b.wavelength; };
  if (samples.size() < 2 || numbers.size() % 2 != 0 || !std::is_sorted(samples.begin(), samples.end(), before))
    parameters.fail(value, "expected two or more pairs of an ascending wavelength and a value");
  return samples;
}

std::optional<RgbD> PbrtSpectra::colour(const PbrtParameters& parameters, std::string_view name) const {
  if (const PbrtParameter* c = parameters.find(name, {"rgb"})) return rgb(parameters, *c);
  if (const PbrtParameter* grey = parameters.find(name, {"float"})) {
    const double value = parameters.number(name, 0, 0, 1e30);
    return grey->numbers.empty() ? RgbD(0.0) : RgbD(value);
  }
  const PbrtParameter* spectrum = parameters.find(name, {"spectrum"});
  if (spectrum == nullptr) {
    if (const PbrtParameter* other = parameters.find(name, {"blackbody"}))
      parameters.fail(*other, "is a black body's light, expected a reflectance");
    return std::nullopt;
  }
  return rgb_of_spectrum(samples(parameters, *spectrum), SpectrumKind::reflectance);
}

RgbD PbrtSpectra::light(const PbrtParameters& parameters, std::string_view name) const {
  if (const PbrtParameter* c = parameters.find(name, {"rgb"})) return rgb(parameters, *c);
  std::vector<SpectrumSample> spectrum;
  if (const PbrtParameter* body = parameters.find(name, {"blackbody"})) {
    if (body->numbers.size() != 1 || !(body->numbers[0] >= 100 && body->numbers[0] <= 1e6))
      parameters.fail(*body, "expected a temperature from 100 to 1000000 kelvin");
    spectrum = blackbody(body->numbers[0]);
  } else if (const PbrtParameter* value = parameters.find(name, {"spectrum"})) {
    const std::string named = value->strings.empty() ? "" : value->strings[0];
    if (named == "stdillum-D65") return RgbD(1.0);
    spectrum = named == "stdillum-A" ? blackbody(2856) : samples(parameters, *value);
  } else {
    return RgbD(1.0);
  }
  const RgbD colour = rgb_of_spectrum(spectrum, SpectrumKind::emission);
  if (!(luminance(colour) > 0)) parameters.fail("the light has no luminance");
  return colour * (1 / luminance(colour));
}

double PbrtSpectra::index(const PbrtParameters& parameters, std::string_view name, double fallback) const {
  const PbrtParameter* spectrum = parameters.find(name, {"spectrum"});
  if (spectrum == nullptr) return parameters.number(name, fallback, 0.001, 1000);
  if (!spectrum->strings.empty())
    if (const auto glass = glasses().find(spectrum->strings[0]); glass != glasses().end()) {
      log_.note(spectrum->at, "glass bends all colours alike, by its index at 588 nm");
      return glass->second;
    }
  log_.note(spectrum->at, "glass bends all colours alike, by its mean index");
  return std::clamp(luminance(rgb_of_spectrum(samples(parameters, *spectrum), SpectrumKind::reflectance)), 0.001,
                    1000.0);
}

std::optional<RgbD> PbrtSpectra::metal(const PbrtParameters& parameters, std::string_view name, bool is_k) const {
  const PbrtParameter* spectrum = parameters.find(name, {"spectrum"});
  if (spectrum == nullptr || spectrum->strings.empty()) return colour(parameters, name);
  const std::string& named = spectrum->strings[0];
  const std::string ending = is_k ? "-k" : "-eta";
  if (!named.starts_with("metal-") || !named.ends_with(ending)) return colour(parameters, name);
  const std::string material = named.substr(6, named.size() - 6 - ending.size());
  std::optional<ComplexIor> ior = conductor_named(material);
  // Brass, which the others do not have: refractiveindex.info at 650, 550 and 450 nm.
  if (material == "CuZn") ior = ComplexIor{{0.444, 0.527, 1.094}, {3.695, 2.765, 1.829}};
  if (!ior) parameters.fail(*spectrum, "names an unknown metal: " + in_quotes(named));
  return is_k ? ior->k : ior->eta;
}

}  // namespace photonproof::inline scenes_pbrt
