// photonproof-trials soak: a thousand renders in one folder. Memory, open files, disk and images must stay the same.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "harness/stress/soak/soak_run.h"
#include "harness/trials/trials.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/verbs.h"
#include "renderer/core/version.h"
#include "renderer/integrators/integrator.h"
#include "scenes/base/input_error.h"
#include "scenes/base/shell_text.h"

namespace photonproof::inline harness_trials {
namespace {

namespace fs = std::filesystem;

struct SoakArguments {
  std::string output = "out/soak", integrator, program, within;
  std::uint64_t renders = 1000;
  double bound = 4096;
};

/// Every integrator, and each method that the photon mapper could choose by itself.
std::vector<SoakMethod> soak_methods(const std::string& only) {
  std::vector<SoakMethod> methods;
  for (const Integrator& row : integrators()) {
    if (!only.empty() && only != row.name) continue;
    methods.push_back({row.name, {"--integrator", row.name}});
    if (std::string(row.name) != "photonmapper") continue;
    for (const char* way : {"map", "gather", "cache"})
      methods.push_back({std::string(row.name) + " " + way, {"--integrator", row.name, "--indirect", way}});
  }
  return methods;
}

SoakOptions soak_options(const SoakArguments& arguments) {
  if (!arguments.integrator.empty() && find_integrator(arguments.integrator) == nullptr)
    throw InputError("--integrator", "'" + arguments.integrator + "' is no integrator");
  SoakOptions options;
  options.folder = arguments.output;
  options.program = program_on_trial(arguments.program);
  options.within = fs::read_symlink("/proc/self/exe");
  options.methods = soak_methods(arguments.integrator);
  options.renders = arguments.renders;
  options.memory_bound = arguments.bound;
  options.version = version_line();
  std::vector<std::string> command{"photonproof-trials", "soak", "--renders", std::to_string(arguments.renders)};
  if (!arguments.integrator.empty()) command.insert(command.end(), {"--integrator", arguments.integrator});
  command.insert(command.end(), {"-o", arguments.output});
  options.command = shell_line(command);
  options.interrupt = &interrupt_flag();
  if (isatty(STDERR_FILENO) != 0)
    options.progress = [](std::uint64_t done, std::uint64_t all) {
      std::fprintf(stderr, "\r\033[K[%llu/%llu]", static_cast<unsigned long long>(done),
                   static_cast<unsigned long long>(all));
      std::fflush(stderr);
    };
  return options;
}

/// Runs `render` in this process with a command line's arguments.
void render_here(const std::vector<std::string>& arguments) {
  if (interrupt_flag()) throw InputError("soak", "was interrupted");
  CLI::App program{"photonproof"};
  int code = 0;
  add_render_verb(program, code);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  reversed.emplace_back("render");
  program.parse(reversed);
  if (code != 0) throw InputError("soak", "a render ended with exit code " + std::to_string(code));
}

int soak(const SoakArguments& arguments) {
  if (!arguments.within.empty()) {
    soak_within(arguments.within, render_here);
    return 0;
  }
  const SoakOptions options = soak_options(arguments);
  const SoakRecord record = run_soak(options);
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r\033[K");
  for (const std::string& problem : record.problems) std::fprintf(stderr, "%s\n", problem.c_str());
  std::printf("%s\nrecord: %s\n", soak_sentence(record).c_str(), (options.folder / "soak.json").c_str());
  if (record.interrupted) return 130;
  if (record.verdict() == DriftVerdict::unclear) return 3;
  return record.verdict() == DriftVerdict::flat ? 0 : 1;
}

}  // namespace

void add_soak_trial(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<SoakArguments>();
  CLI::App* verb = program.add_subcommand(
      "soak",
      "Render small scenes by every integrator again and again in one folder, each as a process, then all within one: "
      "memory,\n"
      "files and disk must not grow, and every image must have the same bits each time.\n"
      "Exit codes: 0 flat, 1 something grows or differs, 2 bad input, 3 cannot tell (more --renders), 130 interrupted");
  verb->add_option("-o,--output", arguments->output, "results folder; its images are replaced")->capture_default_str();
  verb->add_option("--renders", arguments->renders, "the least number of renders by processes, and as many within one")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100'000'000}))
      ->capture_default_str();
  verb->add_option("--bound", arguments->bound, "growth of memory that does not matter, bytes a render")
      ->check(CLI::Range(1.0, 1e9))
      ->capture_default_str();
  verb->add_option("--integrator", arguments->integrator, "this one alone (default: all)");
  verb->add_option("--program", arguments->program,
                   "the program that renders by processes (default: the photonproof beside this program)");
  verb->add_option("--within", arguments->within, "(of soak itself) render within one process what lies there")
      ->group("");
  verb->callback([arguments, &exit_code] { exit_code = soak(*arguments); });
}

}  // namespace photonproof::inline harness_trials
