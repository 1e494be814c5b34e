// photonproof mitsuba: a scene file rendered by Mitsuba 3. It writes an EXR with a variance layer, and a stats JSON in
// the form of the render verb's.
//
// photonproof mitsuba-version prints the version that is installed. It is not in --help.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "harness/verbs/engine_output.h"
#include "harness/verbs/engines/engine_verb.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/scene_options.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reference/mitsuba/mitsuba_engine.h"
#include "reference/mitsuba/mitsuba_python.h"
#include "scenes/description/output_files.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

struct MitsubaArguments {
  SceneOptions scene;
  std::string output;
  MitsubaOptions options;
  EngineOutputs outputs;
};

nlohmann::ordered_json mitsuba_stats_json(const MitsubaArguments& arguments, const MitsubaExport& scene,
                                          const MitsubaRun& run) {
  return {{"schema_version", 1},
          {"engine", "mitsuba"},
          {"version", run.version},
          {"variant", run.variant},
          {"scene", arguments.scene.path},
          {"width", run.rendering.mean.width},
          {"height", run.rendering.mean.height},
          {"seed", arguments.options.seed},
          {"threads", scene.threads},
          {"samples_per_pixel", scene.samples},
          {"batches", scene.picture.batches.size()},
          {"interrupted", false},
          {"wall_seconds", run.wall_seconds},
          {"cpu_seconds", run.cpu_seconds},
          {"import_seconds", run.import_seconds},
          {"load_seconds", run.load_seconds},
          {"compile_seconds", run.compile_seconds},
          {"render_seconds", run.render_seconds},
          {"peak_bytes", run.peak_bytes},
          {"relative_standard_error", run.relative_standard_error},
          {"defects", run.defects}};
}

std::optional<std::string> installed_python() {
  return find_mitsuba_python(std::filesystem::read_symlink("/proc/self/exe"));
}

int run_mitsuba(const MitsubaArguments& arguments) {
  const std::string stats_path =
      checked_stats_path(arguments.outputs.stats_path, arguments.output, arguments.scene.path);
  const SceneDescription description = load_scene(arguments.scene);
  prepare_outputs({arguments.output, stats_path}, scene_inputs(description));
  const MitsubaExport scene = export_mitsuba(description, arguments.options);
  const std::optional<std::string> python = installed_python();
  if (!python) {
    std::fprintf(stderr, "%s\n", no_mitsuba);
    return 3;
  }
  MitsubaRunOptions options;
  options.python = *python;
  options.interrupt = &interrupt_flag();
  Progress progress(arguments.outputs.progress);
  options.progress = progress.callback();
  const MitsubaRun run = render_mitsuba(scene, options);

  const std::string line =
      fmt::format("{}: {} ({}), {}x{}, {} samples a pixel, {:.2f} s", arguments.output, run.version, run.variant,
                  run.rendering.mean.width, run.rendering.mean.height, scene.samples, run.wall_seconds);
  write_engine_outputs(arguments.output, stats_path, run.rendering, mitsuba_stats_json(arguments, scene, run), line,
                       arguments.outputs.json, run.defects);
  return 0;
}

void add_version_verb(CLI::App& program, int& exit_code) {
  CLI::App* verb = program.add_subcommand("mitsuba-version", "print the version of Mitsuba")->group("");
  verb->callback([&exit_code] {
    const std::optional<std::string> python = installed_python();
    const std::string version = python ? mitsuba_version(*python) : "";
    if (!version.empty()) {
      std::printf("%s\n", version.c_str());
      return;
    }
    std::fprintf(stderr, "%s\n", no_mitsuba);
    exit_code = 3;
  });
}

}  // namespace

void add_mitsuba_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<MitsubaArguments>();
  CLI::App* verb =
      add_verb(program, {.name = "mitsuba",
                         .group = render_group,
                         .purpose = "Render a scene with Mitsuba 3 to an EXR and a stats JSON",
                         .examples = {"photonproof mitsuba scenes/library/cornell/scene.xml -o mitsuba.exr --spp 256"},
                         .exit_codes = {done,
                                        bad_input,
                                        {3, "Mitsuba cannot represent the scene, or is not installed; stderr says why"},
                                        engine_failed,
                                        nothing_written}});
  add_scene_options(*verb, arguments->scene);
  add_output_options(*verb, arguments->output, arguments->outputs);
  add_sample_options(*verb, arguments->options.samples, arguments->options.seed);
  verb->add_option("--variant", arguments->options.variant,
                   "Mitsuba's code: llvm_ad_rgb, scalar_rgb (default: the first where libLLVM 17 or newer is found)")
      ->check(CLI::IsMember({"auto", "llvm_ad_rgb", "scalar_rgb"}));
  add_threads_option(*verb, arguments->options.threads);
  add_report_options(*verb, arguments->outputs);
  verb->callback([arguments, &exit_code] {
    exit_code = refusing_with_3([&] { return interruptibly([&] { return run_mitsuba(*arguments); }); });
  });
  add_version_verb(program, exit_code);
}

}  // namespace photonproof::inline harness_verbs_engines
