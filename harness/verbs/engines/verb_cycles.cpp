// photonproof cycles: a scene file rendered by Blender's Cycles to an EXR with a variance layer, and a stats JSON in
// the form of the render verb's.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/verbs/engine_output.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/scene_options.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reference/cycles/cycles_engine.h"
#include "scenes/base/json_text.h"
#include "scenes/description/output_files.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

struct CyclesArguments {
  SceneOptions scene;
  std::string output;
  CyclesOptions options;
  std::string stats_path;
  bool json = false;
  std::string progress = "auto";
};

nlohmann::ordered_json cycles_stats_json(const CyclesArguments& arguments, const CyclesExport& scene,
                                         const CyclesRun& run) {
  return {{"schema_version", 1},
          {"engine", "cycles"},
          {"version", run.version},
          {"scene", arguments.scene.path},
          {"width", run.rendering.mean.width},
          {"height", run.rendering.mean.height},
          {"seed", arguments.options.seed},
          {"threads", scene.threads},
          {"samples_per_pixel", scene.samples},
          {"batches", scene.batches.size()},
          {"interrupted", false},
          {"wall_seconds", run.wall_seconds},
          {"cpu_seconds", run.cpu_seconds},
          {"peak_bytes", run.peak_bytes},
          {"relative_standard_error", run.relative_standard_error},
          {"defects", run.defects}};
}

int run_cycles(const CyclesArguments& arguments) {
  const std::string stats_path = checked_stats_path(arguments.stats_path, arguments.output, arguments.scene.path);
  const SceneDescription description = load_scene(arguments.scene);
  prepare_outputs({arguments.output, stats_path}, scene_inputs(description));
  const CyclesExport scene = export_cycles(description, arguments.options);
  CyclesRunOptions options;
  options.interrupt = &interrupt_flag();
  Progress progress(arguments.progress);
  options.progress = progress.callback();
  const CyclesRun run = render_cycles(scene, options);

  write_exr(arguments.output, run.rendering);
  const nlohmann::ordered_json json = cycles_stats_json(arguments, scene, run);
  write_file_atomically(stats_path, json_text(json) + "\n");
  if (arguments.json)
    std::printf("%s\n", json_text(json).c_str());
  else
    std::printf("%s: Cycles of %s, %dx%d, %d samples a pixel, %.2f s\n", arguments.output.c_str(), run.version.c_str(),
                run.rendering.mean.width, run.rendering.mean.height, scene.samples, run.wall_seconds);
  for (const std::string& defect : run.defects)
    std::fprintf(stderr, "%s: %s\n", arguments.output.c_str(), defect.c_str());
  return 0;
}

}  // namespace

void add_cycles_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<CyclesArguments>();
  CLI::App* verb =
      add_verb(program, {.name = "cycles",
                         .group = render_group,
                         .purpose = "Render a scene with Blender's Cycles to an EXR and a stats JSON",
                         .examples = {"photonproof cycles scenes/library/cornell/scene.xml -o cycles.exr --spp 256"},
                         .exit_codes = {done, bad_input, not_representable, engine_failed, nothing_written}});
  add_scene_options(*verb, arguments->scene);
  begin_option_group(*verb, output_group);
  verb->add_option("-o,--output", arguments->output, "EXR to write")->required();
  verb->add_option("--stats", arguments->stats_path, "stats JSON to write (default: beside the EXR, as .stats.json)");
  begin_option_group(*verb, "Method");
  verb->add_option("--spp", arguments->options.samples, "samples per pixel (default: the scene's)")
      ->transform(whole_number(1, 1 << 24))
      ->type_name("N");
  verb->add_option("--seed", arguments->options.seed, "same seed, same samples; the last bits of the image may differ")
      ->check(is_seed);
  begin_option_group(*verb, run_group);
  verb->add_option("--threads", arguments->options.threads, "worker threads (default: every core)")
      ->check(CLI::Range(1, 1024));
  verb->add_flag("--json", arguments->json, "print the stats as JSON");
  add_progress_option(*verb, arguments->progress);
  add_quiet_option(*verb, arguments->progress);
  verb->callback([arguments, &exit_code] {
    exit_code = refusing_with_3([&] { return interruptibly([&] { return run_cycles(*arguments); }); });
  });
}

}  // namespace photonproof::inline harness_verbs_engines
