// The program: parses the verb, runs it, turns exceptions into exit codes. Nothing else exits.
// 0 done, 2 bad input, usage or too little memory for it, 70 a defect of ours, 130 interrupted (partial results kept);
// verbs document their own.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>

#include "harness/verbs/verbs.h"
#include "renderer/core/version.h"
#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"

namespace {

/// On standard error, without what a terminal would obey: arguments and exceptions may quote anything.
void print_lines(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) std::fprintf(stderr, "%s\n", photonproof::printable(line).c_str());
}

}  // namespace

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
  add_soak_verb(program, exit_code);
  add_faults_verb(program, exit_code);
  add_verify_verb(program, exit_code);
  add_decode_image_verb(program, exit_code);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream help, complaint;
    const int code = program.exit(error, help, complaint);
    std::printf("%s", help.str().c_str());
    print_lines(complaint.str());
    return code == 0 ? 0 : 2;
  } catch (const InputError& error) {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    std::fprintf(stderr, "%s\n", terminal ? error.what() : error.summary().c_str());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "photonproof: out of memory: make the image, the meshes or the number of photons smaller\n");
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    // Of a user's folder: unreadable, gone in the meantime, a name too long.
    print_lines(InputError(error.path1().string(), "cannot be used: " + error.code().message()).summary() + "\n");
    return 2;
  } catch (const std::exception& error) {
    print_lines("photonproof: internal error: " + std::string(error.what()) + "\n");
    return 70;
  }
  return exit_code;
}
