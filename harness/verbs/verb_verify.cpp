// photonproof verify: do independent engines show the same scene, and who is wrong where they do not?

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "harness/verbs/interrupt.h"
#include "harness/verbs/scene_options.h"
#include "harness/verbs/verbs.h"
#include "harness/verify/verify_run.h"
#include "renderer/core/version.h"
#include "scenes/base/shell_text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct VerifyArguments {
  std::vector<std::string> scenes, engines;
  std::string output = "out/verify", rows, size, markdown, csv;
  double power = 0, seconds = 0;  // 0: by --quick
  int threads = 0;
  bool quick = false, probes = true, json = false;
};

std::string command_of(const VerifyArguments& arguments) {
  std::vector<std::string> command{"photonproof", "verify"};
  command.insert(command.end(), arguments.scenes.begin(), arguments.scenes.end());
  for (const std::string& engine : arguments.engines) command.insert(command.end(), {"--engine", engine});
  if (!arguments.rows.empty()) command.insert(command.end(), {"--engines", arguments.rows});
  if (!arguments.size.empty()) command.insert(command.end(), {"--size", arguments.size});
  if (arguments.quick) command.push_back("--quick");
  if (!arguments.probes) command.push_back("--no-probes");
  command.insert(command.end(), {"-o", arguments.output});
  return shell_line(command);
}

VerifyOptions verify_options(const VerifyArguments& arguments) {
  VerifyOptions options;
  const bool is_terminal = isatty(STDERR_FILENO) != 0;
  options.renderer.folder = arguments.output;
  options.renderer.program = fs::read_symlink("/proc/self/exe");
  options.renderer.rows = arguments.rows;
  options.renderer.power = arguments.power > 0 ? arguments.power : arguments.quick ? 0.05 : 0.02;
  options.renderer.seconds = arguments.seconds > 0 ? arguments.seconds : arguments.quick ? 5 : 20;
  options.renderer.quality = arguments.quick ? 1 : 2;
  options.renderer.threads = arguments.threads;
  options.renderer.interrupt = &interrupt_flag();
  options.engines = {arguments.rows, arguments.engines, options.renderer.program};
  for (const std::string& scene : arguments.scenes) options.scenes.emplace_back(scene);
  options.probes = arguments.probes;
  options.version = version_line();
  options.command = command_of(arguments);
  if (!arguments.size.empty()) {
    FilmDescription film;
    apply_size(arguments.size, film);
    options.width = film.width;
    options.height = film.height;
  }
  if (is_terminal)
    options.renderer.at_work = [](const std::string& what) {
      std::fprintf(stderr, "\r\033[K%s", what.c_str());
      std::fflush(stderr);
    };
  options.ended = [is_terminal](const VerifyScene& scene) {
    std::fprintf(stderr, "%s%s: %s\n", is_terminal ? "\r\033[K" : "", scene.name.c_str(), scene.verdict.c_str());
  };
  return options;
}

int verify(const VerifyArguments& arguments) {
  const VerifyOptions options = verify_options(arguments);
  const VerifyRecord record = run_verify(options);
  const fs::path folder = options.renderer.folder, page = folder / "verify.html";
  write_verify_page(record, folder, page);
  if (!arguments.markdown.empty()) write_file_atomically(arguments.markdown, verify_markdown(record));
  if (!arguments.csv.empty()) write_file_atomically(arguments.csv, verify_csv(record));
  if (arguments.json) {
    std::printf("%s", verify_record_text(record).c_str());
  } else {
    std::printf("%srecord: %s\nreport: %s\n", verify_table(record).c_str(), (folder / "verify.json").c_str(),
                page.c_str());
    if (record.interrupted) std::printf("interrupted: the same command goes on from here\n");
  }
  return exit_code_of(record);
}

}  // namespace

void add_verify_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* verb = program.add_subcommand(
      "verify",
      "Render scenes by every engine that can, compare each with each, with the closed form and with the stored\n"
      "reference, and say who is wrong, where, and in which pass of light. What is rendered is kept in the folder.\n"
      "Exit codes: 0 all agree, 1 something is wrong, 2 bad input, 3 nothing is but something is not known, 130 "
      "interrupted");
  verb->add_option("scenes", arguments->scenes, "scene files, or folders with a scene.xml")->required();
  verb->add_option("-o,--output", arguments->output, "results folder")->capture_default_str();
  verb->add_option("--size", arguments->size,
                   "WxH of all pictures (default: the stored reference's, else 64 on the longer side)");
  verb->add_option("--engine", arguments->engines,
                   "this one alone; may be repeated (default: path, bdpt, ptracer, volpath, photonmapper, povray, "
                   "cycles and those of --engines)")
      ->allow_extra_args(false);
  verb->add_option("--engines", arguments->rows, "TOML with further [[engine]] rows, as a suite has them");
  verb->add_flag("--quick", arguments->quick, "an error of 5 % is to be seen, in 5 s an engine and scene");
  verb->add_option("--power", arguments->power, "relative error of the mean that every pair is to show (default 0.02)")
      ->check(CLI::Range(1e-4, 1.0));
  verb->add_option("--seconds", arguments->seconds,
                   "an engine has so long for a scene's samples, in processor time a thread (default 20)")
      ->check(CLI::Range(0.01, 1e5));
  verb->add_option("--threads", arguments->threads, "of each engine (default: every core)")->check(CLI::Range(0, 1024));
  verb->add_flag("--probes,!--no-probes", arguments->probes,
                 "fit every engine to micro-scenes with closed forms first (default)");
  verb->add_option("--markdown", arguments->markdown, "write a table of the scenes there, too");
  verb->add_option("--csv", arguments->csv, "write a row of every pair there, too");
  verb->add_flag("--json", arguments->json, "print the record as JSON (reports/verify/verify.schema.json)");
  verb->callback([arguments, &exit_code] { exit_code = verify(*arguments); });
}

}  // namespace photonproof::inline harness_verbs
