// Indices of refraction by material name: real ones of what is clear, complex ones of conductors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/description/description.h"

namespace photonproof::inline scenes_description {

std::optional<double> ior_named(const std::string& material);
std::vector<std::string> ior_names();

/// eta and k of one of Mitsuba's named materials in linear RGB, equal to those of its rgb variants.
std::optional<ComplexIor> conductor_named(const std::string& material);
std::vector<std::string> conductor_names();

}  // namespace photonproof::inline scenes_description
