#include "scenes/parser/spectrum_value.h"

#include <algorithm>

#include "scenes/base/text_numbers.h"
#include "scenes/parser/scene_objects.h"
#include "scenes/xml/values.h"

namespace photonproof::scene_xml {
namespace {

constexpr const char* of_spectrum = "a number of the spectrum";

void check(const Sources& sources, const Element& element, const std::vector<SpectrumSample>& samples) {
  const Attribute* value = element.find("value") ? element.find("value") : element.find("filename");
  const Attribute& attribute = value ? *value : require(sources, element, "type");
  if (samples.size() < 2) fail_at(sources, attribute, "the spectrum has fewer than two wavelengths");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].value < 0)
      fail_at(sources, attribute,
              "the spectrum is " + format_number(samples[i].value) + " at " + format_number(samples[i].wavelength) +
                  " nm, expected at least 0");
    if (i > 0 && samples[i].wavelength <= samples[i - 1].wavelength)
      fail_at(sources, attribute,
              "the spectrum's wavelengths do not ascend at " + format_number(samples[i].wavelength) + " nm");
  }
}

std::vector<SpectrumSample> pairs_of(const Sources& sources, const Attribute& value) {
  std::vector<SpectrumSample> samples;
  for (const std::string_view pair : split_list(value.value)) {
    const auto colon = pair.find(':');
    if (colon == std::string_view::npos)
      fail_at(sources, value, "the spectrum has " + in_quotes(pair) + ", expected wavelength:value");
    samples.push_back({number_in(sources, value, pair.substr(0, colon), of_spectrum),
                       number_in(sources, value, pair.substr(colon + 1), of_spectrum)});
  }
  return samples;
}

/// A pair of numbers a line; lines that start with # are comments.
std::vector<SpectrumSample> samples_of_file(SceneObjects& objects, const Attribute& filename) {
  const std::string text = objects.files().text(filename);
  std::vector<SpectrumSample> samples;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    const auto words = split_list(line);
    if (words.empty() || words[0][0] == '#') continue;
    if (words.size() != 2)
      fail_at(objects.sources(), filename,
              "the spectrum's file has the line " + in_quotes(line) + ", expected a wavelength and a value");
    samples.push_back({number_in(objects.sources(), filename, words[0], of_spectrum),
                       number_in(objects.sources(), filename, words[1], of_spectrum)});
  }
  return samples;
}

}  // namespace

RgbD spectrum_of(SceneObjects& objects, const Element& element, SpectrumKind kind, double most) {
  const Sources& sources = objects.sources();
  const Attribute* filename = element.find("filename");
  if (filename && element.find("value"))
    fail_at(sources, *filename, "both 'value' and 'filename', expected one of the two");
  const Attribute& given = filename ? *filename : require(sources, element, "value");
  if (!filename && given.value.find(':') == std::string::npos) {
    const double number = number_of(sources, given);
    return kind == SpectrumKind::emission ? rgb_of_xyz(Vec3d(number)) : RgbD(number);
  }
  const auto samples = filename ? samples_of_file(objects, given) : pairs_of(sources, given);
  return rgb_of_samples(sources, element, samples, kind, most);
}

RgbD rgb_of_samples(const Sources& sources, const Element& element, const std::vector<SpectrumSample>& samples,
                    SpectrumKind kind, double most) {
  check(sources, element, samples);
  const RgbD rgb = rgb_of_spectrum(samples, kind);
  return {std::min(rgb.x, most), std::min(rgb.y, most), std::min(rgb.z, most)};
}

}  // namespace photonproof::scene_xml
