// photonproof render: a scene file to an image and a stats JSON beside it.
// Exit codes: 0 done, 1 done but some values are not finite or the image is not denoised, 2 bad input, 130 interrupted
// (partial results kept).

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "harness/verbs/render/render_presets.h"
#include "harness/verbs/render/render_run.h"
#include "harness/verbs/usage/name_hints.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "renderer/integrators/integrator.h"
#include "renderer/passes/aov.h"

namespace photonproof::inline harness_verbs_render {
namespace {

void add_output_options(CLI::App& verb, RenderArguments& arguments) {
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", arguments.output,
                  "image to write: NAME.exr with the variance of each pixel, NAME.pfm or NAME.png");
  verb.add_option("--exposure", arguments.exposure,
                  "stops by which a PNG is brighter than the radiance, whose 1 is white")
      ->check(CLI::Range(-64.0, 64.0))
      ->check(is_finite_number)
      ->type_name("STOPS");
  verb.add_option("--stats", arguments.stats_path, "stats JSON to write (default: beside the image, as .stats.json)");
  verb.add_option("--crop", arguments.crop, "render only this part of the image, in pixels from its upper left corner")
      ->expected(4)
      ->type_name("X Y WIDTH HEIGHT");
  std::vector<std::string> views;
  for (const AovRow& row : aov_table()) views.emplace_back(row.name);
  verb.add_option("--view", arguments.view,
                  "for teaching, with photonmapper or sppm: a part of the light, or how it was found")
      ->check(one_of(views));
  verb.add_flag("--denoise", arguments.denoise,
                "filter the image by Open Image Denoise, found by PHOTONPROOF_OIDN: biased, without a variance layer");
}

void add_budget_options(CLI::App& verb, RenderArguments& arguments) {
  begin_option_group(verb, "Budget");
  verb.add_option("--spp", arguments.spp, "samples per pixel (default: the scene's)")
      ->transform(whole_number(1, std::int64_t{1} << 32))
      ->type_name("N");
  verb.add_option("--photons", arguments.photons, "photons to emit for each map over the whole render")
      ->transform(whole_number(1, std::int64_t{1} << 40))
      ->type_name("N");
  verb.add_option("--seconds", arguments.seconds, "wall time to render for, instead of --spp")
      ->check(CLI::Range(1e-3, 1e7))
      ->check(is_finite_number)
      ->excludes("--spp");
  verb.add_option("--target-error", arguments.target_error,
                  "relative standard error of the image to render to; 0.05 is a relmse of 0.0025")
      ->check(CLI::Range(1e-6, 10.0))
      ->check(is_finite_number)
      ->excludes("--spp")
      ->excludes("--seconds");
}

void add_method_options(CLI::App& verb, RenderArguments& arguments) {
  begin_option_group(verb, "Method");
  std::vector<std::string> names;
  for (const Integrator& row : integrators()) names.emplace_back(row.name);
  std::vector<std::string> presets;
  std::string meanings = "settings that other options override";
  for (const RenderPreset& preset : render_presets()) {
    presets.emplace_back(preset.name);
    meanings += std::string("; ") + preset.meaning;
  }
  verb.add_option("--preset", arguments.preset, meanings)->check(one_of(presets));
  verb.add_option("--integrator", arguments.integrator, "method to render with (default: the scene's)")
      ->check(one_of(names));
  std::vector<std::string> indirect;
  for (const auto& word : indirect_words) indirect.emplace_back(word.text);
  verb.add_option("--indirect", arguments.indirect,
                  "how photonmapper finds light between diffuse surfaces (default: the scene's)")
      ->check(one_of(indirect));
  verb.add_option("--seed", arguments.seed, "seed of the random numbers: same seed, same bits")->check(is_seed);
  verb.add_option("--sampler", arguments.sampler, "random numbers: Owen-scrambled Sobol points, or independent ones")
      ->check(one_of({"sobol", "independent"}));
  verb.add_option("--grid", arguments.grid, "sample the centres of a KxK grid in each pixel")
      ->check(CLI::Range(0, 1024));
  verb.add_option("--no-skip", arguments.no_skip,
                  "do what the plan would skip: a name that --plan prints, or 'all'; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
}

void add_run_options(CLI::App& verb, RenderArguments& arguments) {
  begin_option_group(verb, run_group);
  verb.add_flag("--plan", arguments.plan, "print what would run and what would be skipped, and why; render nothing");
  verb.add_option("--checkpoint", arguments.checkpoint_seconds,
                  "seconds between checkpoints, in OUTPUT.checkpoint until the render is complete; 0: none")
      ->check(CLI::Range(0.0, 1e7))
      ->check(is_finite_number)
      ->capture_default_str();
  verb.add_flag("--resume", arguments.resume,
                "continue from OUTPUT.checkpoint, to the same bits as without a stop; without one, begin anew");
  verb.add_option("--threads", arguments.threads, "worker threads (default: every core)")->check(CLI::Range(0, 1024));
  std::vector<std::string> isas;
  for (const Kernels& kernels : available_kernels()) isas.emplace_back(kernels.isa);
  verb.add_option("--isa", arguments.isa,
                  "instruction set (default: the best here); v3 and v4 give the same bits, others differ")
      ->check(one_of(isas));
  verb.add_flag("--json", arguments.json, "print the stats as JSON");
  verb.add_option("--preview", arguments.preview,
                  "show the image once a second in the viewer tev, which runs: tev, tev:PORT or tev:HOST:PORT");
  add_progress_option(verb, arguments.progress);
  add_quiet_option(verb, arguments.progress);
}

}  // namespace

void add_render_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* verb = add_verb(
      program, {.name = "render",
                .group = render_group,
                .purpose = "Render a scene to an EXR with per-pixel variance, a PFM or a PNG, and a stats JSON",
                .examples = {"photonproof render scenes/library/cornell/scene.xml -o cornell.exr",
                             "photonproof render scenes/library/caustic-glass/scene.xml -o glass.exr "
                             "--integrator photonmapper --seconds 30",
                             "photonproof render scenes/library/cornell/scene.xml --plan"},
                .exit_codes = {done,
                               {1, "done, but some values are not finite, or the image is not denoised"},
                               bad_input,
                               internal_error,
                               {130, "interrupted; the image so far is written, --resume continues"}}});
  add_scene_options(*verb, arguments->scene);
  add_mitsuba_option(*verb, arguments->scene);
  add_output_options(*verb, *arguments);
  add_budget_options(*verb, *arguments);
  add_method_options(*verb, *arguments);
  add_run_options(*verb, *arguments);
  verb->callback([arguments, &exit_code] { exit_code = run_render(*arguments); });
}

}  // namespace photonproof::inline harness_verbs_render
