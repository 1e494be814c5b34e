// photonproof stress: climbs every feature's ladders until they break, and says where.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "harness/stress/stress_run.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/verbs.h"
#include "renderer/core/version.h"
#include "renderer/integrators/integrator.h"
#include "reports/stress/stress_view.h"
#include "scenes/text/input_error.h"
#include "scenes/text/scratch_folder.h"
#include "scenes/text/shell_text.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

struct StressArguments {
  std::string output = "out/stress", only, engine, against, program;
  bool quick = false, list = false;
  int jobs = 0;
};

StressOptions stress_options(const StressArguments& arguments) {
  if (!arguments.engine.empty() && find_integrator(arguments.engine) == nullptr)
    throw InputError("--engine", "'" + arguments.engine + "' is no integrator");
  StressOptions options;
  options.folder = arguments.output;
  options.program = arguments.program.empty() ? fs::read_symlink("/proc/self/exe") : fs::path(arguments.program);
  if (!fs::exists(options.program)) throw InputError("--program", "there is no '" + arguments.program + "'");
  options.only = arguments.only;
  options.engine = arguments.engine;
  options.quick = arguments.quick;
  options.jobs = arguments.jobs;
  options.version = version_line();
  std::vector<std::string> command{"photonproof", "stress"};
  if (!arguments.only.empty()) command.insert(command.end(), {"--only", arguments.only});
  if (!arguments.engine.empty()) command.insert(command.end(), {"--engine", arguments.engine});
  if (arguments.quick) command.push_back("--quick");
  command.insert(command.end(), {"-o", arguments.output});
  options.command = shell_line(command);
  options.interrupt = &interrupt_flag();
  options.ended = [is_terminal = isatty(STDERR_FILENO) != 0](std::size_t ended, std::size_t all,
                                                             const StressLadder& ladder) {
    if (ladder.breakdown() != nullptr)
      std::fprintf(stderr, "%s%s, %s, %s: %s: %s\n", is_terminal ? "\r\033[K" : "", ladder.feature.c_str(),
                   ladder.climb.c_str(), ladder.engine.c_str(), reports::ladder_words(ladder).c_str(),
                   ladder.breakdown()->sentence.c_str());
    if (!is_terminal) return;
    std::fprintf(stderr, "\r\033[K[%zu/%zu] %s, %s, %s", ended, all, ladder.feature.c_str(), ladder.climb.c_str(),
                 ladder.engine.c_str());
    std::fflush(stderr);
  };
  return options;
}

int list_ladders() {
  const ScratchFolder scratch("stress");
  for (const std::string& name : stress_ladder_names(scratch.path())) std::printf("%s\n", name.c_str());
  return 0;
}

int stress(const StressArguments& arguments) {
  if (arguments.list) return list_ladders();
  const StressOptions options = stress_options(arguments);
  std::optional<StressRecord> old;  // read before the run may replace it
  if (!arguments.against.empty()) old = read_stress_record(arguments.against);
  const StressRecord record = run_stress(options);
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r\033[K");
  const std::vector<std::string> worse = old ? steps_back(*old, record) : std::vector<std::string>{};
  const fs::path page = options.folder / "stress.html";
  reports::write_stress_page(record, worse, options.folder, page);
  std::printf("%s", reports::stress_table(record).c_str());
  for (const std::string& sentence : worse) std::printf("step back: %s\n", sentence.c_str());
  if (old && worse.empty()) std::printf("no step back against %s\n", arguments.against.c_str());
  std::printf("record: %s\nreport: %s\n", (options.folder / "stress.json").c_str(), page.c_str());
  if (record.interrupted) {
    std::printf("interrupted: the same command goes on from here\n");
    return 130;
  }
  return record.fails() || !worse.empty() ? 1 : 0;
}

}  // namespace

void add_stress_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<StressArguments>();
  CLI::App* verb = program.add_subcommand(
      "stress",
      "Climb every feature, by size, place, brightness and more, until its picture is wrong, and say where and "
      "whether\n"
      "the program said so. Rungs that are decided are kept in the folder and not rendered again.\n"
      "Exit codes: 0 nothing is silently wrong, 1 something is, or worse than in --against, 2 bad input, 130 "
      "interrupted");
  verb->add_option("-o,--output", arguments->output, "results folder")->capture_default_str();
  verb->add_option("--only", arguments->only, "only ladders whose name contains this; --list has the names");
  verb->add_option("--engine", arguments->engine,
                   "this integrator alone (default: path, photonmapper, bdpt, ptracer, volpath)");
  verb->add_flag("--quick", arguments->quick,
                 "path and photonmapper alone, each ladder at the height that is wanted; only one that is not right "
                 "there is climbed from below");
  verb->add_option("--against", arguments->against, "an earlier stress.json: what is worse than there fails");
  verb->add_option("--program", arguments->program, "another build of photonproof to stress (default: this one)");
  verb->add_option("--jobs", arguments->jobs, "renders at a time (default: one a core)")->check(CLI::Range(1, 1024));
  verb->add_flag("--list", arguments->list, "print the ladders' names and end");
  verb->callback([arguments, &exit_code] { exit_code = stress(*arguments); });
}

}  // namespace photonproof
