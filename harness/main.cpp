// The program: parses the verb, runs it, turns exceptions into exit codes. Nothing else exits.
// 0 done, 2 bad input, usage or too little memory for it, 70 a defect of ours, 130 interrupted (partial results kept);
// verbs document their own.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>

#include "harness/verbs.h"
#include "renderer/version.h"
#include "scenes/input_error.h"

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
  add_compare_verb(program, exit_code);
  add_bench_verb(program, exit_code);
  add_gate_verb(program, exit_code);
  add_reference_verb(program, exit_code);
  add_report_verb(program, exit_code);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  } catch (const InputError& error) {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    std::fprintf(stderr, "%s\n", terminal ? error.what() : error.summary().c_str());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "photonproof: out of memory: make the image, the meshes or the number of photons smaller\n");
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "photonproof: internal error: %s\n", error.what());
    return 70;
  }
  return exit_code;
}
