// One row a verb of the program. Each verb is a file verb_<name>.cpp with its options and its callback.
#pragma once

namespace CLI {
class App;
}

namespace photonproof::inline harness_verbs {

/// Adds the subcommand to `program`; its callback leaves the process's exit code in `exit_code`.
void add_generate_verb(CLI::App& program, int& exit_code);
void add_render_verb(CLI::App& program, int& exit_code);
void add_export_verb(CLI::App& program, int& exit_code);
void add_compare_verb(CLI::App& program, int& exit_code);
void add_bench_verb(CLI::App& program, int& exit_code);
void add_gate_verb(CLI::App& program, int& exit_code);
void add_grade_verb(CLI::App& program, int& exit_code);
void add_reference_verb(CLI::App& program, int& exit_code);
void add_report_verb(CLI::App& program, int& exit_code);
void add_verify_verb(CLI::App& program, int& exit_code);
void add_decode_image_verb(CLI::App& program, int& exit_code);

}  // namespace photonproof::inline harness_verbs

namespace photonproof::inline harness_verbs_engines {
void add_povray_verb(CLI::App& program, int& exit_code);
void add_cycles_verb(CLI::App& program, int& exit_code);
}  // namespace photonproof::inline harness_verbs_engines

namespace photonproof::inline harness_verbs_stress {
void add_stress_verb(CLI::App& program, int& exit_code);
void add_soak_verb(CLI::App& program, int& exit_code);
void add_faults_verb(CLI::App& program, int& exit_code);
}  // namespace photonproof::inline harness_verbs_stress
