// photonproof render: a scene file to an EXR and a stats JSON beside it.
// Exit codes: 0 done, 1 done but some values are not finite, 2 bad input, 130 interrupted (partial results kept).

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "harness/verbs/render_presets.h"
#include "harness/verbs/render_run.h"
#include "harness/verbs/verbs.h"
#include "renderer/integrators/integrator.h"
#include "renderer/passes/aov.h"

namespace photonproof::inline harness_verbs {
namespace {

void add_method_options(CLI::App& verb, RenderArguments& arguments) {
  std::vector<std::string> names;
  for (const Integrator& row : integrators()) names.emplace_back(row.name);
  std::vector<std::string> presets;
  std::string meanings = "settings under one name, which other options override. ";
  for (const RenderPreset& preset : render_presets()) {
    presets.emplace_back(preset.name);
    meanings += preset.meaning;
  }
  verb.add_option("--preset", arguments.preset, meanings)->check(CLI::IsMember(presets));
  verb.add_option("--integrator", arguments.integrator, "instead of the scene's own")->check(CLI::IsMember(names));
  verb.add_option("--seed", arguments.seed, "of the random numbers: same seed, same bits")->check(is_seed);
  std::vector<std::string> indirect;
  for (const auto& word : indirect_words) indirect.emplace_back(word.text);
  verb.add_option("--indirect", arguments.indirect,
                  "of photonmapper, instead of the scene's: how light between diffuse surfaces is found")
      ->check(CLI::IsMember(indirect));
  verb.add_option("--threads", arguments.threads, "worker threads (default: every core)")->check(CLI::Range(0, 1024));
  verb.add_option("--grid", arguments.grid, "samples on the centres of a KxK grid in each pixel")
      ->check(CLI::Range(0, 1024));
  verb.add_option("--sampler", arguments.sampler, "sobol (Owen-scrambled) or independent, to check the other against")
      ->check(CLI::IsMember({"sobol", "independent"}));
  std::vector<std::string> views;
  for (const AovRow& row : aov_table()) views.emplace_back(row.name);
  verb.add_option("--view", arguments.view,
                  "of photonmapper and sppm, for teaching: a part of the light, or how it was found")
      ->check(CLI::IsMember(views));
  std::vector<std::string> isas;
  for (const Kernels& kernels : available_kernels()) isas.emplace_back(kernels.isa);
  verb.add_option("--isa", arguments.isa,
                  "instruction set of the kernels (default: the best this processor has); v3 and v4 give the same "
                  "bits, v2 and scalar other bits each")
      ->check(CLI::IsMember(isas));
  verb.add_option("--no-skip", arguments.no_skip,
                  "do what the plan would skip: a name that --plan prints, or 'all'; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
}

void add_budget_options(CLI::App& verb, RenderArguments& arguments) {
  verb.add_option("--spp", arguments.spp, "samples a pixel (default: the scene's)")
      ->transform(whole_number(1, std::int64_t{1} << 32))
      ->type_name("N");
  verb.add_option("--photons", arguments.photons, "photons emitted for each map over the whole render")
      ->transform(whole_number(1, std::int64_t{1} << 40))
      ->type_name("N");
  verb.add_option("--seconds", arguments.seconds, "wall time to render for, instead of --spp")
      ->check(CLI::Range(1e-3, 1e7))
      ->check(is_finite_number)
      ->excludes("--spp");
  verb.add_option("--target-error", arguments.target_error,
                  "render until the image's relative standard error, as its samples tell it, is at most this: 0.05 for "
                  "a relmse of 0.0025")
      ->check(CLI::Range(1e-6, 10.0))
      ->check(is_finite_number)
      ->excludes("--spp")
      ->excludes("--seconds");
}

void add_run_options(CLI::App& verb, RenderArguments& arguments) {
  verb.add_option(
          "--crop", arguments.crop,
          "render this part of the image alone, in pixels from its upper left corner, instead of the scene's crop")
      ->expected(4)
      ->type_name("X Y WIDTH HEIGHT");
  verb.add_option("--checkpoint", arguments.checkpoint_seconds,
                  "seconds between checkpoints, left as OUTPUT.checkpoint until the render is complete; 0: none")
      ->check(CLI::Range(0.0, 1e7))
      ->check(is_finite_number)
      ->capture_default_str();
  verb.add_flag("--resume", arguments.resume,
                "go on from OUTPUT.checkpoint, to the same bits as a render never stopped; without one, begin anew");
  verb.add_flag("--plan", arguments.plan, "print what would run and what would be skipped, and why; render nothing");
  verb.add_flag("--json", arguments.json, "print the stats as JSON");
  verb.add_flag("--quiet", arguments.quiet, "no progress line");
}

}  // namespace

void add_render_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* verb =
      program.add_subcommand("render", "Render a scene to an EXR with per-pixel variance and a stats JSON");
  add_scene_options(*verb, arguments->scene);
  verb->add_option("-o,--output", arguments->output, "EXR to write");
  verb->add_option("--stats", arguments->stats_path, "stats JSON to write (default: beside the EXR, .stats.json)");
  add_budget_options(*verb, *arguments);
  add_method_options(*verb, *arguments);
  add_run_options(*verb, *arguments);
  verb->callback([arguments, &exit_code] { exit_code = run_render(*arguments); });
}

}  // namespace photonproof::inline harness_verbs
