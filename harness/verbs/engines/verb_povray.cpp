// photonproof povray: a scene file rendered by POV-Ray to an EXR, and a stats JSON in the form of the render verb's.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/verbs/engine_output.h"
#include "harness/verbs/engines/engine_verb.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/povray_arguments.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reference/povray/povray_engine.h"
#include "scenes/description/output_files.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

struct PovrayVerbArguments : PovrayArguments {
  EngineOutputs outputs;
};

nlohmann::ordered_json stats_json(const PovrayVerbArguments& arguments, const PovrayExport& scene,
                                  const PovrayRun& run) {
  return {{"schema_version", 1},
          {"engine", "povray"},
          {"version", run.version},
          {"scene", arguments.scene.path},
          {"width", run.rendering.mean.width},
          {"height", run.rendering.mean.height},
          {"seed", arguments.options.seed},
          {"threads", 1},
          {"quality", arguments.options.quality},
          {"grid", scene.grid},
          {"exposure", scene.exposure},
          {"interrupted", false},
          {"wall_seconds", run.wall_seconds},
          {"cpu_seconds", run.cpu_seconds},
          {"peak_bytes", run.peak_bytes},
          {"phases", run.statistics.phases},
          {"cpu_phases", run.statistics.cpu_phases},
          {"counts", run.statistics.counts},
          {"skipped", scene.skipped},
          {"losses", scene.losses},
          {"defects", run.defects}};
}

int run_povray(const PovrayVerbArguments& arguments) {
  const std::string stats_path =
      checked_stats_path(arguments.outputs.stats_path, arguments.output, arguments.scene.path);
  const SceneDescription description = load_scene(arguments.scene);
  prepare_outputs({arguments.output, stats_path}, scene_inputs(description));
  PovrayOptions povray = arguments.options;
  povray.lights_apart = true;
  const PovrayExport scene = export_povray(description, povray);
  PovrayRunOptions options;
  options.interrupt = &interrupt_flag();
  Progress progress(arguments.outputs.progress);
  options.progress = progress.callback();
  const PovrayRun run = render_povray(scene, options);

  std::string lines =
      fmt::format("{}: {}, {}x{}, quality {}, {:.2f} s", arguments.output, run.version, run.rendering.mean.width,
                  run.rendering.mean.height, arguments.options.quality, run.wall_seconds);
  for (const std::string& skip : scene.skipped) lines += "\nskipped " + skip;
  for (const std::string& loss : scene.losses) lines += "\nloss: " + loss;
  write_engine_outputs(arguments.output, stats_path, run.rendering, stats_json(arguments, scene, run), lines,
                       arguments.outputs.json, run.defects);
  return 0;
}

}  // namespace

void add_povray_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<PovrayVerbArguments>();
  CLI::App* verb = add_verb(
      program, {.name = "povray",
                .group = render_group,
                .purpose = "Render a scene with POV-Ray to an EXR and a stats JSON",
                .examples = {"photonproof povray scenes/library/cornell/scene.xml -o povray.exr",
                             "photonproof povray scenes/library/cornell/scene.xml -o povray.exr --quality high"},
                .exit_codes = {done, bad_input, not_representable, engine_failed, nothing_written}});
  add_povray_arguments(*verb, *arguments, "EXR to write");
  add_stats_option(*verb, arguments->outputs);
  add_report_options(*verb, arguments->outputs);
  verb->callback([arguments, &exit_code] {
    exit_code = refusing_with_3([&] { return interruptibly([&] { return run_povray(*arguments); }); });
  });
}

}  // namespace photonproof::inline harness_verbs_engines
