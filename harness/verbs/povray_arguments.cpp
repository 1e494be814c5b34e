#include "harness/verbs/povray_arguments.h"

#include <CLI/CLI.hpp>

namespace photonproof::inline harness_verbs {

void add_povray_arguments(CLI::App& verb, PovrayArguments& arguments, const std::string& output_help) {
  add_scene_options(verb, arguments.scene);
  verb.add_option("-o,--output", arguments.output, output_help)->required();
  verb.add_option("--grid", arguments.options.grid,
                  "average the centres of KxK sub-pixels (default: refine where there is an edge)")
      ->check(CLI::Range(1, 64));
  verb.add_option("--quality", arguments.options.quality,
                  "1 seconds, 2 tens of seconds, 3 for comparisons that claim agreement, 4 by paths without a cache: "
                  "noise in place of bias, for light that arrives after many bounces")
      ->check(CLI::Range(1, 4));
  verb.add_option("--seed", arguments.options.seed,
                  "of the places of light samples, and of paths: same seed, same bits")
      ->check(is_seed);
}

}  // namespace photonproof::inline harness_verbs
