// photonproof gate: decides a suite's gates and writes the record, the report and JUnit.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/gates/gate_accept.h"
#include "harness/gates/gate_run.h"
#include "harness/gates/gate_self_tests.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "harness/verbs/versions.h"
#include "reports/formats/annotations.h"
#include "reports/formats/exchange_reports.h"
#include "reports/page/html_report.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/base/shell_text.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct GateArguments {
  std::string suite, output, only;
  std::uint64_t seed = 1;
  bool resume = false, fresh = false, json = false, report = true, annotations = false;
  bool self_test = false;
  int runs = 100;
  std::vector<std::string> pool, other_pool;
  std::string accept, reason, progress = "auto";
  std::optional<double> standard_error;
};

// A line for each decided gate, and how far the images of the others are.
class ProgressLines : public GateObserver {
 public:
  explicit ProgressLines(const std::string& mode) : progress_(mode) {}
  void draws(std::size_t drawn, std::size_t total) override {
    progress_.at(counted(drawn, total, "first looks", "images"));
  }
  void looks(std::size_t number, std::size_t total, const Gate& gate, std::size_t images) override {
    progress_.at({.phase = numbered(number, total) + gate.name + ": " + std::to_string(images) + " images"});
  }
  void ended(std::size_t number, std::size_t total, const GateRecord& record) override {
    progress_.say(numbered(number, total) + to_string(record.verdict) + " " + record.name + ": " + record.sentence);
  }

 private:
  Progress progress_;
};

std::vector<fs::path> write_gate_reports(const GateSummary& summary) {
  const fs::path folder = summary.results_file.parent_path();
  const fs::path html = folder / "report.html", junit = folder / "junit.xml";
  write_html_report(summary.results, folder, html);
  write_junit_report(summary.results, folder, junit);
  return {html, junit};
}

void print_gates_json(const GateSummary& summary, const std::vector<fs::path>& reports) {
  nlohmann::ordered_json json = {{"results", summary.results_file.string()},
                                 {"reports", nlohmann::json::array()},
                                 {"pass", summary.count(GateVerdict::pass)},
                                 {"fail", summary.count(GateVerdict::fail)},
                                 {"inconclusive", summary.count(GateVerdict::inconclusive)},
                                 {"accepted", summary.accepted()},
                                 {"interrupted", summary.interrupted},
                                 {"together", summary.results.findings},
                                 {"gates", nlohmann::json::array()}};
  for (const fs::path& report : reports) json["reports"].push_back(report.string());
  for (const GateRecord& gate : summary.results.gates) {
    nlohmann::ordered_json entry = {{"name", gate.name},         {"verdict", to_string(gate.verdict)},
                                    {"sentence", gate.sentence}, {"looks", gate.looks},
                                    {"samples", gate.samples},   {"seconds", gate.seconds}};
    if (gate.status) entry["status"] = to_string(*gate.status);
    if (gate.would_see) entry["would_see"] = *gate.would_see;
    if (gate.would_see_in_a_block) entry["would_see_in_a_block"] = *gate.would_see_in_a_block;
    if (!gate.regression_only.empty()) entry["regression_only"] = gate.regression_only;
    if (!gate.accepted.empty()) entry["accepted"] = gate.accepted;
    json["gates"].push_back(std::move(entry));
  }
  std::printf("%s\n", json_text(json).c_str());
}

void print_gates(const GateSuite& suite, const GateSummary& summary, const std::vector<fs::path>& reports) {
  std::printf("%s: %zu pass, %zu fail, %zu inconclusive%s\n", suite.name.c_str(), summary.count(GateVerdict::pass),
              summary.count(GateVerdict::fail), summary.count(GateVerdict::inconclusive),
              summary.interrupted ? "; interrupted: --resume goes on from here" : "");
  if (const std::size_t accepted = summary.accepted(); accepted > 0)
    std::printf("%zu of these passes were decided before, by the same images (--fresh judges all again)\n", accepted);
  for (const std::string& caveat : summary.results.caveats) std::printf("note: %s\n", caveat.c_str());
  for (const std::string& finding : summary.results.findings) std::printf("together: %s\n", finding.c_str());
  std::printf("results: %s\n", summary.results_file.c_str());
  for (const fs::path& report : reports) std::printf("report: %s\n", report.c_str());
}

/// The suite's path as GitHub knows it: within the checkout.
std::string path_in_checkout(const std::string& suite) {
  const char* checkout = std::getenv("GITHUB_WORKSPACE");
  if (checkout == nullptr || *checkout == '\0') return suite;
  return fs::absolute(suite).lexically_normal().lexically_proximate(fs::path(checkout)).string();
}

int exit_code_of(const GateSummary& summary) {
  if (summary.interrupted) return 130;
  if (std::ranges::any_of(summary.results.gates,
                          [](const GateRecord& gate) { return gate.status == Status::not_started; }))
    return 2;
  if (summary.count(GateVerdict::fail) > 0) return 1;
  return summary.count(GateVerdict::inconclusive) > 0 ? 3 : 0;
}

GateOptions options_of(const GateArguments& arguments, const GateSuite& suite) {
  GateOptions options;
  options.folder = arguments.output.empty() ? fs::path("out") / suite.name : fs::path(arguments.output);
  options.program = fs::read_symlink("/proc/self/exe");
  std::vector<std::string> command{
      "photonproof", "gate", arguments.suite, "-o", options.folder.string(), "--seed", std::to_string(arguments.seed)};
  if (!arguments.only.empty()) command.insert(command.end(), {"--only", arguments.only});
  options.command = shell_line(command);
  options.versions = program_versions();
  options.seed = arguments.seed;
  options.only = arguments.only;
  options.resume = arguments.resume;
  options.fresh = arguments.fresh;
  options.interrupt = &interrupt_flag();
  return options;
}

fs::path faulty_program(const fs::path& program) {
  fs::path faulty = program.parent_path() / "photonproof-faulty";
  if (!fs::exists(faulty))
    throw InputError("--self-test", "needs the program with faults, '" + faulty.string() +
                                        "': cmake --build --preset release --target photonproof_faulty");
  return faulty;
}

/// Goes on as the program with faults, which plants them in itself, too, and draws healthy images with this one.
[[noreturn]] void become(const fs::path& program) {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  unsetenv("PHOTONPROOF_FAULT");
  execv(program.c_str(), argv.data());
  throw InputError("--self-test", "cannot start '" + program.string() + "'");
}

int self_test(const GateArguments& arguments, const GateSuite& suite) {
  SelfTestOptions options;
  options.gates = options_of(arguments, suite);
  options.gates.folder /= "self-test";
  options.faulty = faulty_program(options.gates.program);
  if (!can_plant_in_harness()) become(options.faulty);
  options.gates.program = options.gates.program.parent_path() / "photonproof";
  options.runs = arguments.runs;
  options.pool = read_pool_sizes("--pool", arguments.pool, options.pool.usual);
  options.other_pool = read_pool_sizes("--other-pool", arguments.other_pool, options.other_pool.usual);
  Progress progress(arguments.json ? "none" : arguments.progress);
  options.progress = progress.callback();
  const SelfTest test = run_self_test(suite, options);
  if (test.interrupted) {
    std::printf("interrupted; --resume goes on from here\n");
    return 130;
  }
  std::vector<std::string> command{"photonproof", "gate",   arguments.suite,
                                   "--self-test", "--runs", std::to_string(arguments.runs)};
  for (const auto& [option, sizes] : {std::pair{"--pool", &arguments.pool}, {"--other-pool", &arguments.other_pool}})
    for (const std::string& size : *sizes) command.insert(command.end(), {option, size});
  if (!arguments.only.empty()) command.insert(command.end(), {"--only", arguments.only});
  command.insert(command.end(), {"--seed", std::to_string(arguments.seed)});
  const std::string table = self_test_table(suite, test, shell_line(command));
  write_file_atomically(options.gates.folder / "power.md", table);
  std::printf("%s", table.c_str());
  return self_test_passes(test) ? 0 : 1;
}

int accept(const GateArguments& arguments, const GateSuite& suite) {
  AcceptOptions options;
  options.program = fs::read_symlink("/proc/self/exe");
  options.gate = arguments.accept;
  options.reason = arguments.reason;
  options.who = name_of_user();
  options.standard_error = arguments.standard_error;
  options.interrupt = &interrupt_flag();
  options.versions = program_versions();
  const std::optional<Accepted> accepted = accept_reference(suite, options);
  if (!accepted) return 130;
  std::printf("reference: %s\n%s\n", accepted->file.c_str(), accepted->sentence.c_str());
  return 0;
}

int run_gates(const GateArguments& arguments) {
  const GateSuite suite = read_gate_suite(arguments.suite);
  if (!arguments.accept.empty()) return accept(arguments, suite);
  if (!arguments.reason.empty()) throw InputError("--reason", "is for --accept");
  if (arguments.self_test) return self_test(arguments, suite);
  ProgressLines progress(arguments.progress);
  const GateSummary summary = run_gates(suite, options_of(arguments, suite), progress);
  const std::vector<fs::path> reports = arguments.report ? write_gate_reports(summary) : std::vector<fs::path>{};
  const char* github = std::getenv("GITHUB_ACTIONS");
  if (arguments.json)
    print_gates_json(summary, reports);
  else
    print_gates(suite, summary, reports);
  if (arguments.annotations || (!arguments.json && github != nullptr && std::string(github) == "true"))
    std::fputs(
        reports::github_annotations(reports::arrange(summary.results), path_in_checkout(arguments.suite)).c_str(),
        stdout);
  return exit_code_of(summary);
}

void add_decision_options(CLI::App& verb, GateArguments& arguments) {
  begin_option_group(verb, input_group);
  verb.add_option("suite", arguments.suite, "gate suite (TOML)")->required();
  verb.add_option("--only", arguments.only, "decide only gates whose name contains this");
  verb.add_option("--seed", arguments.seed, "seed of the run: same build, suite and seed, same verdicts (default 1)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000'000}));
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", arguments.output, "results folder (default: out/NAME of the suite)");
  verb.add_flag("--report,!--no-report", arguments.report, "write report.html and junit.xml (default)");
  verb.add_flag("--json", arguments.json, "print the verdicts as JSON");
  verb.add_flag("--annotations", arguments.annotations,
                "print a GitHub annotation for each gate that does not pass (default: in GitHub's CI)");
  begin_option_group(verb, run_group);
  add_progress_option(verb, arguments.progress);
  verb.add_flag("--resume", arguments.resume, "use the images that an interrupted run left in the results folder");
  verb.add_flag("--fresh", arguments.fresh,
                "decide every gate again (default: a gate passes whose first images passed before)");
}

void add_self_test_options(CLI::App& verb, GateArguments& arguments) {
  begin_option_group(verb, "Self-test");
  verb.add_flag("--self-test", arguments.self_test,
                "plant faults; measure how often each gate finds them, and how often it fails without");
  verb.add_option("--runs", arguments.runs, "runs of the self-test for each fault; five times as many without")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  verb.add_option("--pool", arguments.pool,
                  "images that runs draw from, for gates whose name contains NAME; may be repeated (default 64)")
      ->type_name("[NAME=]N")
      ->allow_extra_args(false);
  verb.add_option("--other-pool", arguments.other_pool, "the same for each fault and other condition (default 16)")
      ->type_name("[NAME=]N")
      ->allow_extra_args(false);
}

void add_accept_options(CLI::App& verb, GateArguments& arguments) {
  begin_option_group(verb, "A new reference");
  verb.add_option("--accept", arguments.accept, "render this gate's reference anew and replace the committed one")
      ->type_name("GATE");
  verb.add_option("--reason", arguments.reason, "why, for --accept; the reference's provenance keeps the reason");
  verb.add_option("--standard-error", arguments.standard_error,
                  "relative standard error of the new reference (default: the old one's)")
      ->check(CLI::Range(1e-6, 1.0));
}

}  // namespace

void add_gate_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<GateArguments>();
  CLI::App* verb = add_verb(
      program,
      {.name = "gate",
       .group = judge_group,
       .purpose = "Decide a suite's gates with as many images as each needs; name what fails, and where",
       .examples = {"photonproof gate harness/suites/gates.toml",
                    "photonproof gate harness/suites/gates.toml --only cornell --fresh",
                    "photonproof gate harness/suites/gates.toml --accept cornell/path/agreement "
                    "--reason \"the light is brighter\""},
       .exit_codes = {{0, "every gate passes; with --self-test: the suite finds every fault in 99 of 100 runs"},
                      {1, "a gate fails; with --self-test: the suite misses a fault"},
                      {2, "bad input or usage, or an engine cannot be started"},
                      {3, "no gate fails, but one is inconclusive"},
                      internal_error,
                      {130, "interrupted; --resume continues"}}});
  add_decision_options(*verb, *arguments);
  add_self_test_options(*verb, *arguments);
  add_accept_options(*verb, *arguments);
  verb->callback([arguments, &exit_code] { exit_code = run_gates(*arguments); });
}

}  // namespace photonproof::inline harness_verbs
