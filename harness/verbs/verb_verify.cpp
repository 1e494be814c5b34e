// photonproof verify: do independent engines show the same scene, and who is wrong where they do not?

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "harness/verbs/interrupt.h"
#include "harness/verbs/scene_options.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "harness/verify/verify_run.h"
#include "renderer/core/version.h"
#include "scenes/base/shell_text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct VerifyArguments {
  std::vector<std::string> scenes, engines;
  std::string output = "out/verify", rows, size, markdown, csv;
  double power = 0, seconds = 0;  // 0: by --quick
  int threads = 0;
  std::string progress = "auto";
  bool quick = false, probes = true, json = false;
};

std::string command_of(const VerifyArguments& arguments) {
  std::vector<std::string> command{"photonproof", "verify"};
  command.insert(command.end(), arguments.scenes.begin(), arguments.scenes.end());
  for (const std::string& engine : arguments.engines) command.insert(command.end(), {"--engine", engine});
  if (!arguments.rows.empty()) command.insert(command.end(), {"--engines", arguments.rows});
  if (!arguments.size.empty()) command.insert(command.end(), {"--size", arguments.size});
  if (arguments.quick) command.push_back("--quick");
  if (!arguments.probes) command.push_back("--no-probes");
  command.insert(command.end(), {"-o", arguments.output});
  return shell_line(command);
}

VerifyOptions verify_options(const VerifyArguments& arguments, Progress& progress) {
  VerifyOptions options;
  options.renderer.folder = arguments.output;
  options.renderer.program = fs::read_symlink("/proc/self/exe");
  options.renderer.rows = arguments.rows;
  options.renderer.power = arguments.power > 0 ? arguments.power : arguments.quick ? 0.05 : 0.02;
  options.renderer.seconds = arguments.seconds > 0 ? arguments.seconds : arguments.quick ? 5 : 20;
  options.renderer.quality = arguments.quick ? 1 : 2;
  options.renderer.threads = arguments.threads;
  options.renderer.interrupt = &interrupt_flag();
  options.engines = {arguments.rows, arguments.engines, options.renderer.program};
  for (const std::string& scene : arguments.scenes) options.scenes.emplace_back(scene);
  options.probes = arguments.probes;
  options.version = version_line();
  options.command = command_of(arguments);
  if (!arguments.size.empty()) {
    FilmDescription film;
    apply_size(arguments.size, film);
    options.width = film.width;
    options.height = film.height;
  }
  options.renderer.at_work = [&progress](const std::string& what) { progress.at({.phase = what}); };
  options.ended = [&progress](const VerifyScene& scene) { progress.say(scene.name + ": " + scene.verdict); };
  return options;
}

int verify(const VerifyArguments& arguments) {
  Progress progress(arguments.progress);
  const VerifyOptions options = verify_options(arguments, progress);
  const VerifyRecord record = run_verify(options);
  progress.clear();
  const fs::path folder = options.renderer.folder, page = folder / "verify.html";
  write_verify_page(record, folder, page);
  if (!arguments.markdown.empty()) write_file_atomically(arguments.markdown, verify_markdown(record));
  if (!arguments.csv.empty()) write_file_atomically(arguments.csv, verify_csv(record));
  if (arguments.json) {
    std::printf("%s", verify_record_text(record).c_str());
  } else {
    std::printf("%srecord: %s\nreport: %s\n", verify_table(record).c_str(), (folder / "verify.json").c_str(),
                page.c_str());
    if (record.interrupted) std::printf("interrupted: the same command goes on from here\n");
  }
  return exit_code_of(record);
}

void add_verify_options(CLI::App& verb, VerifyArguments& arguments) {
  begin_option_group(verb, input_group);
  verb.add_option("scenes", arguments.scenes, "scene files, or folders with a scene.xml")->required();
  verb.add_option("--engine", arguments.engines,
                  "compare only this engine and others so named; may be repeated (default: all that can)")
      ->allow_extra_args(false);
  verb.add_option("--engines", arguments.rows, "TOML file with further [[engine]] rows, as in a suite");
  verb.add_flag("--probes,!--no-probes", arguments.probes,
                "check every engine on micro-scenes with closed forms first (default)");
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", arguments.output, "results folder")->capture_default_str();
  verb.add_option("--markdown", arguments.markdown, "file for a table of the scenes");
  verb.add_option("--csv", arguments.csv, "file for a row of every pair");
  verb.add_flag("--json", arguments.json, "print the record as JSON (reports/verify/verify.schema.json)");
  begin_option_group(verb, "Budget");
  verb.add_option("--size", arguments.size,
                  "size of all images (default: the stored reference's, else 64 on the longer side)")
      ->type_name("WxH");
  verb.add_flag("--quick", arguments.quick, "the same as --power 0.05 --seconds 5, with POV-Ray at quality draft");
  verb.add_option("--power", arguments.power, "relative error of the mean that every pair must detect (default 0.02)")
      ->check(CLI::Range(1e-4, 1.0));
  verb.add_option("--seconds", arguments.seconds,
                  "most processor time per thread for an engine's samples of a scene, in seconds (default 20)")
      ->check(CLI::Range(0.01, 1e5));
  add_progress_option(verb, arguments.progress);
  verb.add_option("--threads", arguments.threads, "threads of each engine (default: every core)")
      ->check(CLI::Range(0, 1024));
}

}  // namespace

void add_verify_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* verb = add_verb(
      program,
      {.name = "verify",
       .group = judge_group,
       .purpose = "Render scenes with independent engines, compare all pairs, and find which one is wrong",
       .examples = {"photonproof verify scenes/library/cornell-spheres",
                    "photonproof verify scenes/library/cornell --quick --engine path --engine bdpt"},
       .exit_codes = {{0, "all engines agree"},
                      {1, "an engine, the closed form or the stored reference is wrong"},
                      bad_input,
                      {3, "nothing is wrong, but something is undecided"},
                      internal_error,
                      interrupted_and_kept},
       .notes =
           "Engines by default: path, bdpt, ptracer, volpath, photonmapper, povray, cycles, mitsuba and --engines."});
  add_verify_options(*verb, *arguments);
  verb->callback([arguments, &exit_code] { exit_code = verify(*arguments); });
}

}  // namespace photonproof::inline harness_verbs
