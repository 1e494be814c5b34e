// photonproof report RESULTS.json: writes any of the report formats from a record, without running anything.
// Exit codes are the program's: 0 done, 2 bad input or usage.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/cells/run_follower.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/record_folder.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reports/formats/formats.h"
#include "reports/page/html_report.h"
#include "reports/record/results.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/description/output_files.h"
#include "scenes/files/file_checksum.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::string results;
  std::vector<std::string> formats;
  std::string output;
  std::string methods = "rows";
  std::vector<int> insets;  ///< four numbers for each
  PaperOptions paper;
  std::vector<std::string> given;  ///< options of formats for papers
  bool json = false, watch = false;
};

/// The record, and the images and pictures that it names.
std::vector<InputFile> inputs_of(const std::string& file, const Results& results, const fs::path& folder) {
  std::vector<InputFile> inputs{{file, "the record that is reported"}};
  const auto add = [&](const std::string& name) {
    if (!name.empty()) inputs.push_back({folder / name, "an image of the record"});
  };
  const auto add_all = [&](const auto& entry) {
    add(entry.image);
    for (const auto& [role, picture] : entry.pictures) add(picture);
  };
  for (const Result& result : results.results) add_all(result);
  for (const GateRecord& gate : results.gates) add_all(gate);
  for (const SceneRecord& scene : results.scenes)
    if (scene.reference) {
      add(scene.reference->image);
      add(scene.reference->picture);
    }
  return inputs;
}

/// A picture of another image beside measured numbers misleads: what was replaced is said on the page.
void note_replaced_images(Results& results, const fs::path& folder) {
  for (const Result& result : results.results) {
    if (result.image.empty() || result.image_checksum.empty()) continue;
    const std::string checksum = file_checksum(folder / result.image);
    if (!checksum.empty() && checksum != result.image_checksum)
      results.caveats.push_back(result.image + " is not the image that was measured");
  }
}

/// Throws InputError if an option of one format was given without this format.
void check_options(const ReportOptions& options, const std::vector<const ReportFormat*>& formats) {
  for (const std::string& option : options.given) {
    const auto reads = [&](const ReportFormat& format) {
      return format.options.find(" " + option + " ") != std::string_view::npos;
    };
    std::string known;
    for (const ReportFormat& format : report_formats())
      if (reads(format)) known += (known.empty() ? "" : ", ") + std::string(format.name);
    if (std::ranges::none_of(formats, [&](const ReportFormat* format) { return reads(*format); }))
      throw InputError(option, "needs --format " + known);
  }
}

/// Writes the page again whenever the run has new results. Throws InputError if the page is none that can follow a run.
/// Returns the program's exit code, without the page of the ended run.
int follow(const ReportOptions& options, const std::vector<const ReportFormat*>& formats) {
  if (formats.size() != 1 || formats.front()->name != "html")
    throw InputError("--watch", "follows a run with a page: it needs --format html alone");
  const fs::path folder = folder_of(options.results);
  const fs::path out = options.output.empty() ? folder / "report.html" : fs::path(options.output);
  bool said = false;
  const FollowEnd end = follow_run({options.results, 1, &interrupt_flag()}, [&] {
    const Results results = read_results(options.results);
    prepare_outputs({out}, inputs_of(options.results, results, folder));
    write_live_html_report(results, folder, out);
    if (!said) std::fprintf(stderr, "%s follows the run; Ctrl-C ends this\n", out.c_str());
    said = true;
  });
  return end == FollowEnd::interrupted ? 130 : 0;
}

/// Returns the program's exit code.
int write_reports(const ReportOptions& options) {
  std::vector<const ReportFormat*> formats;
  for (const std::string& name : options.formats) formats.push_back(&report_format(name));
  if (formats.empty()) formats.push_back(&report_formats().front());
  if (!options.output.empty() && formats.size() > 1) {
    throw InputError("--output", "names one file, but more than one format is asked for");
  }
  const bool is_device = options.results.starts_with("/dev/") && !options.results.starts_with("/dev/shm/");
  if (options.output.empty() && (is_device || options.results.starts_with("/proc/")))
    throw InputError(options.results, "cannot have a report beside it: name the report with -o");
  check_options(options, formats);
  const int code = options.watch ? follow(options, formats) : 0;
  if (code != 0 && !fs::exists(options.results)) return code;  // interrupted before the first result
  Results results = read_results(options.results);
  const fs::path folder = folder_of(options.results);
  note_replaced_images(results, folder);
  std::vector<fs::path> outputs;
  for (const ReportFormat* format : formats)
    outputs.push_back(options.output.empty() ? folder / ("report" + std::string(format->extension))
                                             : fs::path(options.output));
  prepare_outputs(outputs, inputs_of(options.results, results, folder));
  nlohmann::json written = nlohmann::json::array();
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const ReportFormat* format = formats[i];
    const fs::path& out = outputs[i];
    format->write(results, folder, out, options.paper);
    if (options.json) {
      written.push_back({{"format", format->name}, {"file", out.string()}});
    } else {
      std::printf("%s\n", out.string().c_str());
    }
  }
  if (options.json) std::printf("%s\n", json_text(nlohmann::json{{"written", written}}).c_str());
  return code;
}

void add_paper_options(CLI::App& verb, ReportOptions& options) {
  verb.add_option("--methods", options.methods, "side of LaTeX tables that has the methods: rows (default) or columns")
      ->type_name("rows|columns")
      ->check(CLI::IsMember({"rows", "columns"}));
  verb.add_option("--table", options.paper.tables,
                  "LaTeX tables to write (default: all): races, equal-time, errors, points, slopes, gates")
      ->delimiter(',')
      ->type_name("NAME,...")
      ->allow_extra_args(false);
  verb.add_option("--scene", options.paper.scene, "the only scene to plot, or the scene of a figure")
      ->type_name("NAME");
  verb.add_option("--inset", options.insets, "crop of a figure in pixels: left, top, width and height; repeatable")
      ->type_size(4)
      ->type_name("X Y W H")
      ->expected(1)
      ->take_all();
}

}  // namespace

void add_report_verb(CLI::App& program, int& exit_code) {
  CLI::App* verb =
      add_verb(program, {.name = "report",
                         .group = measure_group,
                         .purpose = "Write reports from the record of a run of bench or gate",
                         .examples = {"photonproof report out/first-light/results.json --format html,markdown",
                                      "photonproof report out/first-light/results.json --format latex -o table.tex",
                                      "photonproof report out/first-light/results.json --watch"},
                         .exit_codes = {done, bad_input, internal_error, {130, "interrupted while following a run"}}});
  begin_option_group(*verb, output_group);
  const auto options = std::make_shared<ReportOptions>();
  std::string known;
  for (const ReportFormat& format : report_formats())
    known += known.empty() ? std::string(format.name) + " (default)" : ", " + std::string(format.name);
  verb->add_option("results", options->results, "results.json of a run; pictures are found beside it")->required();
  verb->add_option("--format", options->formats, known)->delimiter(',')->type_name("NAME,...")->allow_extra_args(false);
  verb->add_option("-o,--output", options->output,
                   "file to write, with one format (default: report.html, report.md ... beside the record)");
  add_paper_options(*verb, *options);
  verb->add_flag("--watch", options->watch, "follow a run that goes on: the page is made anew with every result");
  verb->add_flag("--json", options->json, "print what was written as JSON");
  verb->callback([verb, options, &exit_code] {
    for (const char* name : {"--methods", "--table", "--scene", "--inset"})
      if (verb->count(name) > 0) options->given.push_back(name);
    options->paper.methods = options->methods == "columns" ? MethodsSide::columns : MethodsSide::rows;
    for (std::size_t i = 0; i + 3 < options->insets.size(); i += 4)
      options->paper.insets.push_back(
          {options->insets[i], options->insets[i + 1], options->insets[i + 2], options->insets[i + 3]});
    exit_code = write_reports(*options);
  });
}

}  // namespace photonproof::inline harness_verbs
