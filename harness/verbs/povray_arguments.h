// Arguments of the two verbs that translate a scene into POV-Ray's language.
#pragma once

#include <string>

#include "harness/verbs/scene_options.h"
#include "reference/povray/povray_options.h"

namespace photonproof::inline harness_verbs {

struct PovrayArguments {
  SceneOptions scene;
  std::string output;
  PovrayOptions options;
};

/// The digit of a quality that a user names or gives as a digit. Throws CLI::ValidationError for another.
std::string povray_quality_digit(const std::string& text);

/// The scene's options, -o, --grid, --quality, --seed.
void add_povray_arguments(CLI::App& verb, PovrayArguments& arguments, const std::string& output_help);

}  // namespace photonproof::inline harness_verbs
