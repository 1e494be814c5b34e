// One row a verb of the program. Each verb is a file verb_<name>.cpp with its options and its callback. `run_program`
// is the main function of all programs with verbs.
#pragma once

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs {

/// Adds the subcommand to `program`; its callback leaves the process's exit code in `exit_code`.
void add_generate_verb(CLI::App& program, int& exit_code);
void add_export_verb(CLI::App& program, int& exit_code);
void add_compare_verb(CLI::App& program, int& exit_code);
void add_bench_verb(CLI::App& program, int& exit_code);
void add_gate_verb(CLI::App& program, int& exit_code);
void add_grade_verb(CLI::App& program, int& exit_code);
void add_reference_verb(CLI::App& program, int& exit_code);
void add_report_verb(CLI::App& program, int& exit_code);
void add_verify_verb(CLI::App& program, int& exit_code);
void add_history_verb(CLI::App& program, int& exit_code);
void add_view_verb(CLI::App& program, int& exit_code);
void add_decode_image_verb(CLI::App& program, int& exit_code);

/// Parses the arguments and runs the verb. Returns the process's exit code: the `exit_code` that the verb's callback
/// left, 2 for bad input, bad usage or too little memory, 70 for an internal error. Errors go to standard error.
int run_program(CLI::App& program, int argc, char** argv, const int& exit_code);

}  // namespace photonproof::inline harness_verbs

namespace photonproof::inline harness_verbs_engines {
void add_convert_verb(CLI::App& program, int& exit_code);
void add_povray_verb(CLI::App& program, int& exit_code);
void add_cycles_verb(CLI::App& program, int& exit_code);
void add_mitsuba_verb(CLI::App& program, int& exit_code);
void add_denoiser_verb(CLI::App& program, int& exit_code);
}  // namespace photonproof::inline harness_verbs_engines

namespace photonproof::inline harness_verbs_render {
void add_render_verb(CLI::App& program, int& exit_code);
}  // namespace photonproof::inline harness_verbs_render

namespace photonproof::inline harness_verbs_stress {
void add_stress_verb(CLI::App& program, int& exit_code);
}  // namespace photonproof::inline harness_verbs_stress

namespace photonproof::inline harness_verbs_start {
void add_demo_verb(CLI::App& program, int& exit_code);
void add_init_verb(CLI::App& program, int& exit_code);
/// `scenes`, `engines`, `metrics` and `suites`.
void add_list_verbs(CLI::App& program, int& exit_code);
void add_completions_verb(CLI::App& program, int& exit_code);
}  // namespace photonproof::inline harness_verbs_start
