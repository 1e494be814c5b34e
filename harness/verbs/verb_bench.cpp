// photonproof bench: runs a suite and writes its results and reports.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/bench/bench.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/scene_options.h"
#include "harness/verbs/usage/colour_option.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "harness/verbs/versions.h"
#include "reports/formats/markdown_report.h"
#include "reports/page/html_report.h"
#include "reports/view/console_conclusions.h"
#include "reports/view/races.h"
#include "reports/view/verdicts.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/base/shell_text.h"
#include "scenes/description/output_files.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::string suite;
  std::string output;
  bool fresh = false;
  bool retry = false;
  std::string only;
  std::string program, against, old_program;
  AgainstOptions limits;
  double slower_percent = 100 * ChangeThresholds{}.seconds;
  double error_percent = 100 * ChangeThresholds{}.relmse;
  bool json = false;
  std::string colour = "auto", progress = "auto";
  bool report = true;
};

std::string ending_of(const Result& result) {
  if (result.status != Status::ok) return to_string(result.status) + ": " + result.detail;
  char text[64];
  std::snprintf(text, sizeof text, "finished %.2f s", result.wall_seconds.value_or(0));
  return text;
}

// A line for each finished cell. Where the line of progress rewrites itself, only failures stay.
class BenchProgressLines : public BenchObserver {
 public:
  explicit BenchProgressLines(const std::string& mode) : progress_(mode) {}
  void starts(std::size_t number, std::size_t total, const Cell& cell) override {
    progress_.at(counted(number - 1, total, cell.label(), "cells"));
  }
  void ended(std::size_t number, std::size_t total, const Result& result) override {
    const std::string what = result.cell.label() + " " + ending_of(result);
    if (progress_.rewrites() && result.status == Status::ok)
      progress_.at(counted(number, total, what, "cells"));
    else
      progress_.say(numbered(number, total) + what);
  }
  void changed(const ChangeRecord& change) override {
    progress_.say(change.scene + "/" + change.engine + "/" + change.budget.label() + ": " + change.sentence);
  }
  void done() { progress_.clear(); }

 private:
  Progress progress_;
};

// Metrics and pictures may change with any rebuild; which build this is, the program file's time says.
std::string build_identity(const fs::path& program) {
  std::error_code ignored;
  return program_versions().at("photonproof") + " " +
         std::to_string(fs::last_write_time(program, ignored).time_since_epoch().count());
}

std::size_t failures(const BenchSummary& summary) {
  std::size_t count = 0;
  for (const auto& [status, number] : summary.by_status)
    if (status != Status::ok && status != Status::unsupported) count += number;
  return count;
}

std::vector<fs::path> write_reports(const Results& results, const fs::path& folder) {
  const fs::path html = folder / "report.html", markdown = folder / "report.md";
  write_html_report(results, folder, html);
  write_markdown_report(results, folder, markdown);
  return {html, markdown};
}

/// Throws InputError when what is written would replace what is read.
void check_bench_outputs(const BenchArguments& arguments, const Suite& suite, const fs::path& folder) {
  std::vector<fs::path> reads{arguments.suite, arguments.against};
  for (const SuiteScene& scene : suite.scenes) reads.push_back(scene.path);
  for (const char* name : {"results.json", "report.html", "report.md"})
    for (const fs::path& read : reads)
      if (!read.empty() && same_file(folder / name, read))
        throw InputError(read.string(), "is read, and would be replaced: choose another results folder with -o");
}

void print_json(const BenchSummary& summary, const std::vector<fs::path>& reports) {
  nlohmann::ordered_json json = {{"results", summary.results_file.string()},
                                 {"reports", nlohmann::json::array()},
                                 {"measured", summary.measured},
                                 {"kept", summary.kept},
                                 {"missing", summary.missing},
                                 {"seconds", summary.seconds},
                                 {"engine_seconds", summary.engine_seconds},
                                 {"harness_cpu_seconds", summary.harness_cpu_seconds},
                                 {"interrupted", summary.interrupted},
                                 {"status", nlohmann::json::object()}};
  for (const fs::path& report : reports) json["reports"].push_back(report.string());
  for (const auto& [status, number] : summary.by_status) json["status"][to_string(status)] = number;
  if (!summary.by_change.empty()) json["changes"] = nlohmann::json::object();
  for (const auto& [change, number] : summary.by_change) json["changes"][to_string(change)] = number;
  std::printf("%s\n", json_text(json).c_str());
}

void print_changes(const BenchSummary& summary) {
  const char* separator = "against the old run: ";
  for (const auto& [change, number] : summary.by_change) {
    std::printf("%s%zu %s", separator, number, to_string(change).c_str());
    separator = ", ";
  }
  if (!summary.by_change.empty()) std::printf("\n");
}

void print_text(const Suite& suite, const BenchSummary& summary, const Results& results,
                const std::vector<fs::path>& report_files, bool colours) {
  std::printf("%s: %zu images measured, %zu kept from before", suite.name.c_str(), summary.measured, summary.kept);
  if (summary.missing > 0) std::printf(", %zu not run", summary.missing);
  const char* separator = "; ";
  for (const auto& [status, number] : summary.by_status) {
    std::printf("%s%zu %s", separator, number, reports::status_text(status).c_str());
    separator = ", ";
  }
  const reports::View view = reports::arrange(results);
  std::printf("\n%s", reports::console_conclusions(view, colours).c_str());
  if (summary.measured == 0 && !summary.interrupted)
    std::printf("nothing to run: every image asked for has its result (--fresh measures again, --retry what failed)\n");
  if (summary.interrupted) std::printf("interrupted: kept what was finished; the same command goes on from here\n");
  std::printf("results: %s\n", summary.results_file.c_str());
  for (const fs::path& report : report_files) std::printf("report: %s\n", report.c_str());
  print_changes(summary);
  if (const std::string sentence = reports::races_sentence(view); !sentence.empty())
    std::printf("%s\n", sentence.c_str());
}

int exit_code_of(const BenchArguments& arguments, const BenchSummary& summary) {
  if (summary.interrupted) return 130;
  const auto count = [&](Change change) {
    const auto found = summary.by_change.find(change);
    return found == summary.by_change.end() ? std::size_t{0} : found->second;
  };
  if (summary.by_status.count(Status::not_started) > 0) return 2;
  if (failures(summary) > 0 || count(Change::regression) > 0) return 1;
  const bool compared_nothing = !arguments.against.empty() && summary.by_change.empty();
  return compared_nothing || count(Change::inconclusive) > 0 ? 3 : 0;
}

int run(const BenchArguments& arguments) {
  const std::atomic<bool>& interrupt = interrupt_flag();
  const Suite suite = read_suite(arguments.suite);
  BenchOptions options;
  options.results_folder = arguments.output.empty() ? fs::path("out") / suite.name : fs::path(arguments.output);
  const fs::path self = fs::read_symlink("/proc/self/exe");
  options.program = arguments.program.empty() ? self : fs::absolute(arguments.program).lexically_normal();
  if (!fs::is_regular_file(options.program)) throw InputError("--program", "no such file: " + options.program.string());
  std::vector<std::string> command{"photonproof", "bench", arguments.suite, "-o", options.results_folder.string()};
  if (!arguments.program.empty()) command.insert(command.end(), {"--program", arguments.program});
  options.command = shell_line(command);
  options.versions = program_versions();
  options.versions[program_key] = options.program.string();
  options.versions[program_hash_key] = program_hash(options.program);
  options.comparison_version = build_identity(self);
  options.fresh = arguments.fresh;
  options.retry = arguments.retry;
  options.only = arguments.only;
  options.interrupt = &interrupt;
  if (!arguments.against.empty()) {
    options.against = arguments.limits;
    options.against->results = arguments.against;
    options.against->old_program = arguments.old_program;
    options.against->thresholds.seconds = arguments.slower_percent / 100;
    options.against->thresholds.relmse = arguments.error_percent / 100;
  }

  check_bench_outputs(arguments, suite, options.results_folder);
  BenchProgressLines progress(arguments.progress);
  const BenchSummary summary = run_bench(suite, options, progress);
  progress.done();
  const Results results = read_results(summary.results_file.string());
  const std::vector<fs::path> report_files =
      arguments.report ? write_reports(results, summary.results_file.parent_path()) : std::vector<fs::path>{};
  if (arguments.json)
    print_json(summary, report_files);
  else
    print_text(suite, summary, results, report_files, colours_on(arguments.colour, STDOUT_FILENO));
  return exit_code_of(arguments, summary);
}

void add_suite_options(CLI::App& verb, BenchArguments& arguments) {
  begin_option_group(verb, input_group);
  verb.add_option("suite", arguments.suite, "suite (TOML)")->required();
  verb.add_option("--only", arguments.only, "run only cells whose label contains this, e.g. cornell/path");
  verb.add_option("--program", arguments.program,
                  "program that {photonproof} stands for in engines (default: this one)");
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", arguments.output, "results folder (default: out/NAME of the suite)");
  verb.add_flag("--report,!--no-report", arguments.report, "write report.html and report.md (default)");
  verb.add_flag("--json", arguments.json, "print the summary as JSON");
  add_colour_option(verb, arguments.colour);
  begin_option_group(verb, run_group);
  add_progress_option(verb, arguments.progress);
  verb.add_flag("--fresh", arguments.fresh, "measure finished cells again; their old results stay beside the new ones");
  verb.add_flag("--retry", arguments.retry, "measure cells again that timed out, crashed or wrote a bad image");
}

void add_against_options(CLI::App& verb, BenchArguments& arguments) {
  begin_option_group(verb, "Comparison with an older run");
  auto* against = verb.add_option("--against", arguments.against,
                                  "results.json of the older run; report what became slower or worse");
  verb.add_option("--old-program", arguments.old_program,
                  "older program to run next to the new one (default: compare stored numbers)")
      ->needs(against);
  verb.add_option("--against-seconds", arguments.limits.seconds, "most seconds for each scene and engine")
      ->check(CLI::Range(0.0, 1e6))
      ->check(is_finite_number)
      ->capture_default_str();
  verb.add_option("--against-rounds", arguments.limits.most_rounds, "most rounds for each scene and engine")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  verb.add_option("--slower", arguments.slower_percent, "percent of processor time that count as slower")
      ->check(CLI::Range(0.01, 1000.0))
      ->check(is_finite_number)
      ->capture_default_str();
  verb.add_option("--more-error", arguments.error_percent, "percent of relmse that count as worse")
      ->check(CLI::Range(0.01, 1000.0))
      ->check(is_finite_number)
      ->capture_default_str();
}

}  // namespace

void add_bench_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* verb = add_verb(
      program,
      {.name = "bench",
       .group = measure_group,
       .purpose = "Run a suite: every scene, engine, budget and seed in its own process",
       .examples =
           {"photonproof bench harness/suites/first-light.toml",
            "photonproof bench harness/suites/first-light.toml -o out/new --against out/first-light/results.json"},
       .exit_codes = {done,
                      {1, "a cell timed out, crashed or wrote a bad image, or --against found a regression"},
                      {2, "bad input or usage, or an engine cannot be started"},
                      {3, "--against could not decide"},
                      internal_error,
                      interrupted_and_kept}});
  add_suite_options(*verb, *arguments);
  add_against_options(*verb, *arguments);
  verb->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace photonproof::inline harness_verbs
