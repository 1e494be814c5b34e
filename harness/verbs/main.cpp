// The program: its verbs. Exit codes: 0 done, 2 bad input, usage or too little memory for it, 70 a defect of ours, 130
// interrupted (partial results kept); verbs document their own.

#include <CLI/CLI.hpp>

#include "harness/verbs/verbs.h"
#include "renderer/core/version.h"

int main(int argc, char** argv) {
  using namespace photonproof;
  CLI::App program{"photonproof: a photon-mapping renderer and the harness that proves it right"};
  program.set_version_flag("--version", version_line());
  program.require_subcommand(1);
  int exit_code = 0;
  add_generate_verb(program, exit_code);
  add_render_verb(program, exit_code);
  add_export_verb(program, exit_code);
  add_povray_verb(program, exit_code);
  add_cycles_verb(program, exit_code);
  add_compare_verb(program, exit_code);
  add_bench_verb(program, exit_code);
  add_gate_verb(program, exit_code);
  add_grade_verb(program, exit_code);
  add_reference_verb(program, exit_code);
  add_report_verb(program, exit_code);
  add_stress_verb(program, exit_code);
  add_verify_verb(program, exit_code);
  add_decode_image_verb(program, exit_code);
  return run_program(program, argc, argv, exit_code);
}
