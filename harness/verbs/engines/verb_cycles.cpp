// photonproof cycles: a scene file rendered by Blender's Cycles to an EXR with a variance layer, and a stats JSON in
// the form of the render verb's.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/verbs/engine_output.h"
#include "harness/verbs/engines/engine_verb.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/scene_options.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reference/cycles/cycles_engine.h"
#include "scenes/description/output_files.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

struct CyclesArguments {
  SceneOptions scene;
  std::string output;
  CyclesOptions options;
  EngineOutputs outputs;
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
  const std::string stats_path =
      checked_stats_path(arguments.outputs.stats_path, arguments.output, arguments.scene.path);
  const SceneDescription description = load_scene(arguments.scene);
  prepare_outputs({arguments.output, stats_path}, scene_inputs(description));
  const CyclesExport scene = export_cycles(description, arguments.options);
  CyclesRunOptions options;
  options.interrupt = &interrupt_flag();
  Progress progress(arguments.outputs.progress);
  options.progress = progress.callback();
  const CyclesRun run = render_cycles(scene, options);

  const std::string line =
      fmt::format("{}: Cycles of {}, {}x{}, {} samples a pixel, {:.2f} s", arguments.output, run.version,
                  run.rendering.mean.width, run.rendering.mean.height, scene.samples, run.wall_seconds);
  write_engine_outputs(arguments.output, stats_path, run.rendering, cycles_stats_json(arguments, scene, run), line,
                       arguments.outputs.json, run.defects);
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
  add_output_options(*verb, arguments->output, arguments->outputs);
  add_sample_options(*verb, arguments->options.samples, arguments->options.seed);
  add_threads_option(*verb, arguments->options.threads);
  add_report_options(*verb, arguments->outputs);
  verb->callback([arguments, &exit_code] {
    exit_code = refusing_with_3([&] { return interruptibly([&] { return run_cycles(*arguments); }); });
  });
}

}  // namespace photonproof::inline harness_verbs_engines
