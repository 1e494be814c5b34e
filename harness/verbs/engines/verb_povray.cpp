// photonproof povray: a scene file rendered by POV-Ray to an EXR, and a stats JSON in the form of the render verb's.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/verbs/engine_output.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/povray_arguments.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reference/povray/povray_engine.h"
#include "scenes/base/json_text.h"
#include "scenes/description/output_files.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

struct PovrayVerbArguments : PovrayArguments {
  std::string stats_path;
  bool json = false;
  std::string progress = "auto";
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
  const std::string stats_path = checked_stats_path(arguments.stats_path, arguments.output, arguments.scene.path);
  const SceneDescription description = load_scene(arguments.scene);
  prepare_outputs({arguments.output, stats_path}, scene_inputs(description));
  PovrayOptions povray = arguments.options;
  povray.lights_apart = true;
  const PovrayExport scene = export_povray(description, povray);
  PovrayRunOptions options;
  options.interrupt = &interrupt_flag();
  Progress progress(arguments.progress);
  options.progress = progress.callback();
  const PovrayRun run = render_povray(scene, options);

  write_exr(arguments.output, run.rendering);
  const nlohmann::ordered_json json = stats_json(arguments, scene, run);
  write_file_atomically(stats_path, json_text(json) + "\n");

  if (arguments.json) {
    std::printf("%s\n", json_text(json).c_str());
  } else {
    std::printf("%s: %s, %dx%d, quality %d, %.2f s\n", arguments.output.c_str(), run.version.c_str(),
                run.rendering.mean.width, run.rendering.mean.height, arguments.options.quality, run.wall_seconds);
    for (const std::string& skip : scene.skipped) std::printf("skipped %s\n", skip.c_str());
    for (const std::string& loss : scene.losses) std::printf("loss: %s\n", loss.c_str());
  }
  for (const std::string& defect : run.defects)
    std::fprintf(stderr, "%s: %s\n", arguments.output.c_str(), defect.c_str());
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
  verb->add_option("--stats", arguments->stats_path, "stats JSON to write (default: beside the EXR, as .stats.json)");
  begin_option_group(*verb, run_group);
  verb->add_flag("--json", arguments->json, "print the stats as JSON");
  add_progress_option(*verb, arguments->progress);
  add_quiet_option(*verb, arguments->progress);
  verb->callback([arguments, &exit_code] {
    exit_code = refusing_with_3([&] { return interruptibly([&] { return run_povray(*arguments); }); });
  });
}

}  // namespace photonproof::inline harness_verbs_engines
