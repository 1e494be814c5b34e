// photonproof-trials faults: small runs meet kills, bad disks, a second run, clock changes and little memory. Their
// final result must be that of an undisturbed run.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "harness/stress/faults/bad_disk.h"
#include "harness/stress/faults/faults_run.h"
#include "harness/trials/trials.h"
#include "harness/verbs/interrupt.h"
#include "renderer/core/version.h"
#include "scenes/base/input_error.h"
#include "scenes/base/shell_text.h"

namespace photonproof::inline harness_trials {
namespace {

namespace fs = std::filesystem;

constexpr int quick_kills = 20;

struct FaultsArguments {
  std::string output = "out/faults", only, program;
  std::optional<int> kills;
  std::uint64_t seed = 1;
  bool quick = false, list = false;
};

FaultsOptions faults_options(const FaultsArguments& arguments) {
  FaultsOptions options;
  options.folder = arguments.output;
  options.program = program_on_trial(arguments.program);
  options.quick = arguments.quick;
  options.kills = arguments.kills.value_or(arguments.quick ? quick_kills : FaultsOptions{}.kills);
  options.only = arguments.only;
  options.seed = arguments.seed;
  options.version = version_line();
  std::vector<std::string> command{"photonproof-trials",          "faults", "--kills",
                                   std::to_string(options.kills), "--seed", std::to_string(options.seed)};
  if (!arguments.only.empty()) command.insert(command.end(), {"--only", arguments.only});
  if (arguments.quick) command.emplace_back("--quick");
  command.insert(command.end(), {"-o", arguments.output});
  options.command = shell_line(command);
  options.interrupt = &interrupt_flag();
  options.progress = [is_terminal = isatty(STDERR_FILENO) != 0, told = std::string()](
                         int done, int all, const FaultOutcome& outcome) mutable {
    if (!outcome.broken.empty() && told != outcome.broken.back()) {
      told = outcome.broken.back();
      std::fprintf(stderr, "%s%s, %s: %s\n", is_terminal ? "\r\033[K" : "", outcome.fault.c_str(), outcome.work.c_str(),
                   told.c_str());
    }
    if (!is_terminal) return;
    std::fprintf(stderr, "\r\033[K[%d/%d] %s, %s", done, all, outcome.fault.c_str(), outcome.work.c_str());
    std::fflush(stderr);
  };
  return options;
}

int faults(const FaultsArguments& arguments) {
  if (arguments.list) {
    for (const std::string& name : fault_names()) std::printf("%s\n", name.c_str());
    return 0;
  }
  const FaultsOptions options = faults_options(arguments);
  const FaultsRecord record = run_faults(options);
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r\033[K");
  std::printf("%srecord: %s\n", faults_table(record).c_str(), (options.folder / "faults.json").c_str());
  if (record.interrupted) {
    std::printf("interrupted: the same command goes on from here\n");
    return 130;
  }
  return record.fails() ? 1 : 0;
}

void add_bad_disk_trial(CLI::App& program, int& exit_code) {
  struct Arguments {
    BadDisk disk;
    std::vector<std::string> command;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* verb = program.add_subcommand("on-bad-disk", "(of faults itself) a command whose disk is slow or fails");
  verb->group("");
  verb->add_option("--delay", arguments->disk.delay_seconds, "seconds that every call that writes waits");
  verb->add_option("--fails-after", arguments->disk.fails_after_seconds, "seconds until calls fail with EIO");
  verb->add_option("--folder", arguments->disk.folder, "what fails");
  verb->add_option("command", arguments->command, "and its arguments")->required();
  verb->callback([arguments, &exit_code] { exit_code = run_on_bad_disk(arguments->disk, arguments->command); });
}

}  // namespace

void add_faults_trial(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<FaultsArguments>();
  CLI::App* verb = program.add_subcommand(
      "faults",
      "Kill small runs of bench, gate, reference, grade and render at random moments, let their disk be full, "
      "read-only,\n"
      "slow, failing or gone, their clock jump and their memory be small, and check that the result stays the same.\n"
      "Decided trials are kept in the folder and not tried again.\n"
      "Exit codes: 0 all held, 1 something did not, 2 bad input, 130 interrupted");
  verb->add_option("-o,--output", arguments->output, "results folder")->capture_default_str();
  verb->add_option("--kills", arguments->kills,
                   "the number of kills, all works together (default 1000, with --quick 20)")
      ->check(CLI::Range(0, 10'000'000));
  verb->add_flag("--quick", arguments->quick, "one trial of every other fault on every work");
  verb->add_option("--only", arguments->only, "only faults on works whose name contains this; --list has the names");
  verb->add_option("--seed", arguments->seed, "decides every moment")->check(CLI::Range(1, 1'000'000'000));
  verb->add_option("--program", arguments->program,
                   "another program to try (default: the photonproof beside this one)");
  verb->add_flag("--list", arguments->list, "print the names of the faults and end");
  verb->callback([arguments, &exit_code] { exit_code = faults(*arguments); });
  add_bad_disk_trial(program, exit_code);
}

}  // namespace photonproof::inline harness_trials
