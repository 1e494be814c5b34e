// photonproof-trials: tests photonproof by a thousand renders, kills and bad disks.

#include <CLI/CLI.hpp>

#include "harness/trials/trials.h"
#include "harness/verbs/verbs.h"
#include "renderer/core/version.h"

int main(int argc, char** argv) {
  using namespace photonproof;
  CLI::App program{"photonproof-trials: soaks and fault trials of the photonproof beside it"};
  program.set_version_flag("--version", version_line());
  program.require_subcommand(1);
  int exit_code = 0;
  add_soak_trial(program, exit_code);
  add_faults_trial(program, exit_code);
  return run_program(program, argc, argv, exit_code);
}
