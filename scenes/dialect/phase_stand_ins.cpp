#include "scenes/dialect/phase_stand_ins.h"

#include <algorithm>
#include <vector>

namespace photonproof::scene_xml {
namespace {

/// Mean cosine of values that are linear between cosines at equal distances from -1 to 1; 0 where there are none.
double mean_cosine(const std::vector<double>& values) {
  double sum = 0, moment = 0;
  const double step = 2.0 / static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double from = -1 + static_cast<double>(i) * step, a = values[i], b = values[i + 1];
    sum += step * (a + b) / 2;
    moment += step * (from * (a + b) / 2 + step * (a + 2 * b) / 6);
  }
  return sum > 0 ? moment / sum : 0;
}

}  // namespace

void replace_phase(Element& phase, StandInNotes& notes) {
  if (value_of(phase, "type") != "tabphase") return;
  const Element* given = parameter_of(phase, "values");
  std::vector<double> values;
  const std::string text = given != nullptr ? value_of(*given, "value") : "";
  for (const std::string_view word : split_list(text)) {
    const auto parsed = parse_number(word);
    if (!parsed.value || *parsed.value < 0) return;  // the reader tells that it does not know the plugin
    values.push_back(*parsed.value);
  }
  if (values.size() < 2) return;
  notes.add_stand_in(phase, "hg", "it has the same mean cosine");
  set_attribute(phase, "type", "hg");
  phase.children.clear();
  add_parameter(phase, "float", "g", format_number(std::clamp(mean_cosine(values), -0.999, 0.999)));
}

}  // namespace photonproof::scene_xml
