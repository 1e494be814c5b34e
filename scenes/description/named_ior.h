// Indices of refraction by material name.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline scenes_description {

std::optional<double> ior_named(const std::string& material);
std::vector<std::string> ior_names();

}  // namespace photonproof::inline scenes_description
