#include "harness/verbs/program/whole_program.h"

#include <CLI/CLI.hpp>

#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "renderer/core/version.h"

namespace photonproof::inline harness_verbs_program {

void make_whole_program(CLI::App& program, int& exit_code) {
  begin_program_usage(program, "photonproof: a photon-mapping renderer, and the harness that proves it right",
                      {"photonproof render scenes/library/cornell/scene.xml -o cornell.exr --spp 64",
                       "photonproof compare reference.exr cornell.exr --fail relmse=0.01"});
  program.name("photonproof");
  program.set_version_flag("--version", version_line(), "print the version");
  program.require_subcommand(1);
  add_demo_verb(program, exit_code);
  add_init_verb(program, exit_code);
  add_list_verbs(program, exit_code);
  add_render_verb(program, exit_code);
  add_generate_verb(program, exit_code);
  add_convert_verb(program, exit_code);
  add_export_verb(program, exit_code);
  add_povray_verb(program, exit_code);
  add_cycles_verb(program, exit_code);
  add_mitsuba_verb(program, exit_code);
  add_reference_verb(program, exit_code);
  add_compare_verb(program, exit_code);
  add_view_verb(program, exit_code);
  add_bench_verb(program, exit_code);
  add_report_verb(program, exit_code);
  add_gate_verb(program, exit_code);
  add_history_verb(program, exit_code);
  add_verify_verb(program, exit_code);
  add_grade_verb(program, exit_code);
  add_stress_verb(program, exit_code);
  add_completions_verb(program, exit_code);
  add_decode_image_verb(program, exit_code);
  add_denoiser_verb(program, exit_code);
  finish_program_usage(program,
                       {{0, "done, and nothing is wrong"},
                        {1, "something is wrong: a gate fails, a cell crashed, a value is not finite"},
                        {2, "bad input or usage, or too little memory"},
                        {3, "undecided, or another program cannot represent the scene"},
                        {70, "internal error, or another program failed"},
                        {130, "interrupted; finished work is kept"}},
                       "compare has codes of its own. Each verb lists its options, examples and exit codes:\n"
                       "photonproof VERB --help. More: docs/verbs/ and README.md");
}

}  // namespace photonproof::inline harness_verbs_program
