#include "harness/verbs/povray_arguments.h"

#include <CLI/CLI.hpp>
#include <iterator>

#include "harness/verbs/usage/verb_usage.h"
#include "scenes/base/edit_distance.h"

namespace photonproof::inline harness_verbs {
namespace {

/// A name that a user may give for a quality of POV-Ray's (reference/povray/povray_options.h).
struct QualityName {
  const char* name;
  int quality;
};
constexpr QualityName quality_names[] = {{"draft", 1}, {"medium", 2}, {"high", 3}, {"paths", 4}};

}  // namespace

std::string povray_quality_digit(const std::string& text) {
  std::vector<std::string> names;
  for (const auto& [name, quality] : quality_names) {
    const std::string digit = std::to_string(quality);
    if (text == name || text == digit) return digit;
    names.emplace_back(name);
  }
  throw CLI::ValidationError("'" + text + "' is not a quality" + did_you_mean(text, names) + ", expected " +
                             join_or(names) + ", or 1 to " + std::to_string(std::size(quality_names)));
}

void add_povray_arguments(CLI::App& verb, PovrayArguments& arguments, const std::string& output_help) {
  add_scene_options(verb, arguments.scene);
  begin_option_group(verb, "Method");
  std::string qualities;
  for (const auto& [name, quality] : quality_names)
    qualities += (qualities.empty() ? "" : ", ") + std::to_string(quality) + " " + name;
  verb.add_option("--quality", arguments.options.quality,
                  "effort of POV-Ray: " + qualities + " (paths has noise in place of bias)")
      ->transform(povray_quality_digit)
      ->type_name("NAME")
      ->default_str("draft");
  verb.add_option("--grid", arguments.options.grid,
                  "average the centres of KxK sub-pixels (default: refine where there is an edge)")
      ->check(CLI::Range(1, 64));
  verb.add_option("--seed", arguments.options.seed, "seed of light samples and of paths: same seed, same bits")
      ->check(is_seed);
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", arguments.output, output_help)->required();
}

}  // namespace photonproof::inline harness_verbs
