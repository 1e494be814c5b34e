#include "scenes/description/named_ior.h"

#include <array>
#include <utility>

namespace photonproof::inline scenes_description {
namespace {

/// Mitsuba's names for indices of refraction (its manual, table "ior-table-list"; after Hecht, Optics).
constexpr std::array<std::pair<const char*, double>, 23> kIors = {
    {{"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
     {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
     {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
     {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
     {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
     {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
     {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
     {"pet", 1.5750},      {"diamond", 2.419}}};

}  // namespace

std::optional<double> ior_named(const std::string& material) {
  for (const auto& [name, ior] : kIors)
    if (material == name) return ior;
  return std::nullopt;
}

std::vector<std::string> ior_names() {
  std::vector<std::string> names;
  for (const auto& [name, ior] : kIors) names.emplace_back(name);
  return names;
}

}  // namespace photonproof::inline scenes_description
