// The program. Exit codes: 0 done, 2 bad input, usage or too little memory for it, 70 a defect of ours, 130 interrupted
// (partial results kept); verbs document their own.

#include <CLI/CLI.hpp>

#include "harness/verbs/program/whole_program.h"
#include "harness/verbs/verbs.h"

int main(int argc, char** argv) {
  using namespace photonproof;
  CLI::App program;
  int exit_code = 0;
  make_whole_program(program, exit_code);
  return run_program(program, argc, argv, exit_code);
}
