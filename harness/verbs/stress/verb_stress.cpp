// photonproof stress: runs every feature's sweeps until they break, and reports where.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "harness/stress/stress_run.h"
#include "harness/suites/engines.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "renderer/core/version.h"
#include "renderer/integrators/integrator.h"
#include "reports/stress/stress_view.h"
#include "scenes/base/input_error.h"
#include "scenes/base/shell_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_verbs_stress {
namespace {

namespace fs = std::filesystem;

struct StressArguments {
  std::string output = "out/stress", engines_file, against, program, markdown, progress = "auto";
  std::vector<std::string> only, engines;
  bool quick = false, turned = false, list = false;
  int jobs = 0;
};

std::vector<Engine> engines_of_file(const std::string& file) {
  std::vector<Engine> all = builtin_engines();
  for (Engine& engine : engines_from_toml(TomlTable::parse(read_file(file), file), all))
    all.push_back(std::move(engine));
  return all;
}

StressOptions stress_options(const StressArguments& arguments, Progress& progress) {
  StressOptions options;
  options.others = arguments.engines_file.empty() ? builtin_engines() : engines_of_file(arguments.engines_file);
  std::erase_if(options.others, [](const Engine& engine) { return find_integrator(engine.name) != nullptr; });
  for (const std::string& name : arguments.engines) {
    const auto is_asked_for = [&](const Engine& engine) { return engine.name == name; };
    const bool is_known = find_integrator(name) != nullptr || name == "compare" ||
                          std::any_of(options.others.begin(), options.others.end(), is_asked_for);
    if (!is_known) throw InputError("--engine", "'" + name + "' is neither an integrator nor a row of engines");
  }
  options.folder = arguments.output;
  options.program = arguments.program.empty() ? fs::read_symlink("/proc/self/exe") : fs::path(arguments.program);
  options.is_other_program = !arguments.program.empty();
  if (!fs::exists(options.program)) throw InputError("--program", "there is no '" + arguments.program + "'");
  options.only = arguments.only;
  options.engines = arguments.engines;
  options.quick = arguments.quick;
  options.turned = arguments.turned;
  options.jobs = arguments.jobs;
  options.version = version_line();
  std::vector<std::string> command{"photonproof", "stress"};
  for (const std::string& part : arguments.only) command.insert(command.end(), {"--only", part});
  for (const std::string& engine : arguments.engines) command.insert(command.end(), {"--engine", engine});
  if (!arguments.engines_file.empty()) command.insert(command.end(), {"--engines", arguments.engines_file});
  if (arguments.quick) command.push_back("--quick");
  if (arguments.turned) command.push_back("--turned");
  command.insert(command.end(), {"-o", arguments.output});
  options.command = shell_line(command);
  options.interrupt = &interrupt_flag();
  options.ended = [&progress](std::size_t ended, std::size_t all, const StressSweep& sweep) {
    const std::string name = sweep.feature + ", " + sweep.sweep_run + ", " + sweep.engine;
    if (sweep.breakdown() != nullptr)
      progress.say(name + ": " + reports::sweep_words(sweep) + ": " + sweep.breakdown()->sentence);
    progress.at(counted(ended, all, name, "sweeps"));
  };
  return options;
}

int list_sweeps() {
  const ScratchFolder scratch("stress");
  for (const std::string& name : stress_sweep_names(scratch.path())) std::printf("%s\n", name.c_str());
  return 0;
}

int stress(const StressArguments& arguments) {
  if (arguments.list) return list_sweeps();
  Progress progress(arguments.progress);
  const StressOptions options = stress_options(arguments, progress);
  std::optional<StressRecord> old;  // read before the run may replace it
  if (!arguments.against.empty()) old = read_stress_record(arguments.against);
  const StressRecord record = run_stress(options);
  progress.clear();
  const std::vector<std::string> worse = old ? steps_back(*old, record) : std::vector<std::string>{};
  const fs::path page = options.folder / "stress.html";
  reports::write_stress_page(record, worse, options.folder, page);
  if (!arguments.markdown.empty()) write_file_atomically(arguments.markdown, reports::stress_markdown(record));
  std::printf("%s", reports::stress_table(record).c_str());
  for (const std::string& sentence : worse) std::printf("regression: %s\n", sentence.c_str());
  if (old && worse.empty()) std::printf("no regression against %s\n", arguments.against.c_str());
  std::printf("record: %s\nreport: %s\n", (options.folder / "stress.json").c_str(), page.c_str());
  if (record.interrupted) {
    std::printf("interrupted: the same command goes on from here\n");
    return 130;
  }
  return record.fails() || !worse.empty() ? 1 : 0;
}

void add_stress_options(CLI::App& verb, StressArguments& arguments) {
  begin_option_group(verb, input_group);
  verb.add_option("--only", arguments.only, "run only sweeps whose name contains this; may be repeated")
      ->allow_extra_args(false);
  verb.add_flag("--list", arguments.list, "print the names of all sweeps; run nothing");
  verb.add_option("--engine", arguments.engines,
                  "use only this integrator, compare, povray, or row of --engines; may be repeated")
      ->allow_extra_args(false);
  verb.add_option("--engines", arguments.engines_file,
                  "TOML file with [[engine]] rows, as in a suite; --engine chooses them");
  verb.add_option("--program", arguments.program,
                  "another build of photonproof to stress, without the sweeps that it refuses (default: this one)");
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", arguments.output, "results folder")->capture_default_str();
  verb.add_option("--against", arguments.against, "an earlier stress.json; sweeps that got worse since fail");
  verb.add_option("--markdown", arguments.markdown, "file for the table of all sweeps");
  begin_option_group(verb, run_group);
  add_progress_option(verb, arguments.progress);
  verb.add_flag("--quick", arguments.quick,
                "path and photonmapper at the required levels; full sweeps only where these fail");
  verb.add_flag("--turned", arguments.turned, "turn every scene, so that no face lies along an axis");
  verb.add_option("--jobs", arguments.jobs, "renders at a time (default: one per core)")->check(CLI::Range(1, 1024));
}

}  // namespace

void add_stress_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<StressArguments>();
  CLI::App* verb = add_verb(
      program,
      {.name = "stress",
       .group = maintain_group,
       .purpose = "Run every feature's sweeps by size, place, brightness and more until the image is wrong",
       .examples = {"photonproof stress --quick", "photonproof stress --only sphere --engine path -o out/sphere",
                    "photonproof stress --list"},
       .exit_codes = {{0, "no image is wrong without a warning or an error"},
                      {1, "an image is wrong in silence, or a sweep is worse than in --against"},
                      bad_input,
                      internal_error,
                      interrupted_and_kept},
       .notes = "Engines by default: path, photonmapper, bdpt, ptracer, volpath and compare."});
  add_stress_options(*verb, *arguments);
  verb->callback([arguments, &exit_code] { exit_code = stress(*arguments); });
}

}  // namespace photonproof::inline harness_verbs_stress
