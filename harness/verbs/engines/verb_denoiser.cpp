// photonproof denoiser: prints the library that `render --denoise` uses, as the version of engines that denoise. Not in
// --help. Exit code 3: there is none, or it does not run here.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "harness/verbs/verbs.h"
#include "renderer/denoising/denoiser.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_verbs_engines {

void add_denoiser_verb(CLI::App& program, int& exit_code) {
  CLI::App* verb = program.add_subcommand("denoiser", "print the library of render --denoise")->group("");
  verb->callback([&exit_code] {
    try {
      std::printf("Open Image Denoise %s\n", Denoiser(oidn_in_environment(), 1).version().c_str());
    } catch (const InputError& error) {
      std::fprintf(stderr, "%s\n", error.summary().c_str());
      exit_code = 3;
    }
  });
}

}  // namespace photonproof::inline harness_verbs_engines
