// photonproof mitsuba: a scene file rendered by Mitsuba 3 to an EXR with a variance layer, and a stats JSON in the form
// of the render verb's.
//
// photonproof mitsuba-version prints the version that is installed. It is not in --help.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "harness/verbs/engine_output.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/scene_options.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reference/mitsuba/mitsuba_engine.h"
#include "reference/mitsuba/mitsuba_python.h"
#include "scenes/base/json_text.h"
#include "scenes/description/output_files.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

struct MitsubaArguments {
  SceneOptions scene;
  std::string output;
  MitsubaOptions options;
  std::string stats_path;
  bool json = false;
  std::string progress = "auto";
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
  const std::string stats_path = checked_stats_path(arguments.stats_path, arguments.output, arguments.scene.path);
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
  Progress progress(arguments.progress);
  options.progress = progress.callback();
  const MitsubaRun run = render_mitsuba(scene, options);

  write_exr(arguments.output, run.rendering);
  const nlohmann::ordered_json json = mitsuba_stats_json(arguments, scene, run);
  write_file_atomically(stats_path, json_text(json) + "\n");
  if (arguments.json)
    std::printf("%s\n", json_text(json).c_str());
  else
    std::printf("%s: %s (%s), %dx%d, %d samples a pixel, %.2f s\n", arguments.output.c_str(), run.version.c_str(),
                run.variant.c_str(), run.rendering.mean.width, run.rendering.mean.height, scene.samples,
                run.wall_seconds);
  for (const std::string& defect : run.defects)
    std::fprintf(stderr, "%s: %s\n", arguments.output.c_str(), defect.c_str());
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
  begin_option_group(*verb, output_group);
  verb->add_option("-o,--output", arguments->output, "EXR to write")->required();
  verb->add_option("--stats", arguments->stats_path, "stats JSON to write (default: beside the EXR, as .stats.json)");
  begin_option_group(*verb, "Method");
  verb->add_option("--spp", arguments->options.samples, "samples per pixel (default: the scene's)")
      ->transform(whole_number(1, 1 << 24))
      ->type_name("N");
  verb->add_option("--seed", arguments->options.seed, "same seed, same samples; the last bits of the image may differ")
      ->check(is_seed);
  verb->add_option("--variant", arguments->options.variant,
                   "Mitsuba's code: llvm_ad_rgb, scalar_rgb (default: the first where libLLVM 17 or newer is found)")
      ->check(CLI::IsMember({"auto", "llvm_ad_rgb", "scalar_rgb"}));
  begin_option_group(*verb, run_group);
  verb->add_option("--threads", arguments->options.threads, "worker threads (default: every core)")
      ->check(CLI::Range(1, 1024));
  verb->add_flag("--json", arguments->json, "print the stats as JSON");
  add_progress_option(*verb, arguments->progress);
  add_quiet_option(*verb, arguments->progress);
  verb->callback([arguments, &exit_code] {
    exit_code = refusing_with_3([&] { return interruptibly([&] { return run_mitsuba(*arguments); }); });
  });
  add_version_verb(program, exit_code);
}

}  // namespace photonproof::inline harness_verbs_engines
