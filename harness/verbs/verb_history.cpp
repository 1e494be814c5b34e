// photonproof history: keeps records of bench and gate by commit, shows them with the steps found, and comments on pull
// requests. Exit codes are the program's: 0 done, 1 something is worse (comment --fail), 2 bad input or usage.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/history/history_changes.h"
#include "harness/history/history_date.h"
#include "harness/history/history_file.h"
#include "harness/history/history_pictures.h"
#include "harness/history/history_steps.h"
#include "harness/history/history_values.h"
#include "harness/verbs/engine_output.h"
#include "harness/verbs/record_folder.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "reports/history/history_comparison.h"
#include "reports/history/history_page.h"
#include "reports/history/history_words.h"
#include "reports/record/results.h"
#include "reports/view/console_table.h"
#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"
#include "scenes/description/output_files.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct HistoryOptions {
  std::vector<std::string> records;
  std::string file = "history.db";
  std::string commit, date;
  std::string page = "history.html", comment = "comment.md";
  std::string base, head, picture_url;
  std::size_t pictures = 6;
  bool fail = false;
};

/// The hash in "photonproof 0.2.0 (836524249e63)": it stands for the sources of the renderer.
std::string own_commit(const std::string& file, const Results& results) {
  const auto found = results.versions.find("photonproof");
  const std::string version = found == results.versions.end() ? "" : found->second;
  const std::size_t open = version.find('('), close = version.find(')', open == std::string::npos ? 0 : open);
  if (open == std::string::npos || close == std::string::npos || close < open + 2)
    throw InputError(file, "names no version of photonproof: give its commit by --commit");
  return version.substr(open + 1, close - open - 1);
}

void check_commit(const std::string& where, const std::string& name) {
  constexpr std::size_t longest = 200;
  if (name.empty() || name.size() > longest || printable(name) != name || name.find('\t') != std::string::npos)
    throw InputError(where, "is not the name of a commit, expected 1 to 200 printable characters");
}

HistoryRecord record_of(const HistoryOptions& options, const std::string& file) {
  const Results results = read_results(file);
  HistoryRecord record;
  record.checksum = file_checksum(file);
  record.commit = options.commit.empty() ? own_commit(file, results) : options.commit;
  check_commit(options.commit.empty() ? file : "--commit", record.commit);
  record.date = options.date.empty() ? parse_date(file, results.created) : parse_date("--date", options.date);
  record.suite = results.suite;
  record.values = values_of(results);
  record.pictures = pictures_of(results, folder_of(file));
  if (record.values.empty()) throw InputError(file, "has no finished cell and no gate with a value");
  return record;
}

/// All records are read before the first is added.
void run_add(const HistoryOptions& options) {
  std::vector<InputFile> inputs;
  for (const std::string& file : options.records) inputs.push_back({file, "a record to add"});
  prepare_outputs({options.file}, inputs);
  std::vector<HistoryRecord> records;
  for (const std::string& file : options.records) records.push_back(record_of(options, file));
  HistoryFile history(options.file, SqliteDatabase::Access::write);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const bool is_new = history.add(records[i]);
    const std::string name = printable(reports::commit_text(records[i].commit));
    if (is_new)
      std::printf("%s: %zu values at commit %s, %s\n", options.records[i].c_str(), records[i].values.size(),
                  name.c_str(), reports::date_text(records[i].date).c_str());
    else
      std::printf("%s: there already, at commit %s\n", options.records[i].c_str(), name.c_str());
  }
}

reports::History history_of(HistoryFile& file, const std::string& name) {
  reports::History history = file.load();
  if (history.series.empty()) throw InputError(name, "has no records");
  find_steps(history);
  if (history.left_out > 0) std::fprintf(stderr, "%zu values are not finite and left out\n", history.left_out);
  return history;
}

void print_series(const reports::History& history) {
  using reports::ConsoleCell;
  std::vector<std::vector<ConsoleCell>> rows;
  for (const reports::HistorySeries& series : history.series) {
    if (!series.is_judged) continue;
    const reports::SeriesKey& key = series.key;
    std::string last = "none";
    if (!series.steps.empty()) {
      const reports::HistoryStep& step = series.steps.back();
      last = reports::change_text(key, step) + " at " +
             reports::commit_text(history.commits[series.points[step.point].commit].name);
    }
    const bool is_gate = key.measure == reports::Measure::gate;
    rows.push_back({ConsoleCell{printable(key.scene)}, ConsoleCell{printable(key.engine)},
                    ConsoleCell{printable(is_gate ? "" : key.budget)},
                    ConsoleCell{printable(reports::measure_text(key))},
                    ConsoleCell{std::to_string(series.points.size())},
                    ConsoleCell{reports::value_text(key, series.points.back().value)}, ConsoleCell{printable(last)}});
  }
  std::fputs(
      reports::console_table({"scene", "engine", "budget", "quantity", "commits", "now", "last step"}, rows, 4, false)
          .c_str(),
      stdout);
}

void run_show(const HistoryOptions& options) {
  check_extension(options.page, ".html", "a page");
  prepare_outputs({options.page}, {{options.file, "the history"}});
  HistoryFile file(options.file, SqliteDatabase::Access::read);
  const reports::History history = history_of(file, options.file);
  reports::write_history_page(history, fs::path(options.file).filename().string(), options.page);
  print_series(history);
  std::printf("\npage: %s\n%s\n", options.page.c_str(), printable(reports::last_step_sentence(history)).c_str());
}

int run_comment(const HistoryOptions& options) {
  check_extension(options.comment, ".md", "a comment");
  prepare_outputs({options.comment}, {{options.file, "the history"}});
  HistoryFile file(options.file, SqliteDatabase::Access::read);
  const reports::History history = history_of(file, options.file);
  const std::size_t head =
      options.head.empty() ? history.commits.size() - 1 : find_commit(history, "--head", options.head);
  if (options.base.empty() && head == 0) throw InputError("--base", "no commit is older than the head: name one");
  const std::size_t base = options.base.empty() ? head - 1 : find_commit(history, "--base", options.base);
  if (base == head) throw InputError("--base", "is the head itself");
  reports::HistoryComparison comparison = compare_commits(history, base, head);
  const fs::path pictures =
      fs::path(options.comment).replace_filename(fs::path(options.comment).stem().string() + "-pictures");
  compare_pictures(file.pictures_of(comparison.base.name), file.pictures_of(comparison.head.name), pictures,
                   options.pictures, comparison);
  write_file_atomically(options.comment, reports::comparison_markdown(comparison, options.picture_url));
  std::printf("comment: %s\n", options.comment.c_str());
  if (!comparison.pictures.empty()) std::printf("pictures: %s\n", pictures.c_str());
  std::printf("%s\n", printable(reports::comparison_sentence(comparison)).c_str());
  return options.fail && is_worse(comparison) ? 1 : 0;
}

void add_add_verb(CLI::App& verb, HistoryOptions& options) {
  begin_option_group(verb, input_group);
  verb.add_option("records", options.records, "results.json of bench or gate; its pictures are found beside it")
      ->required();
  verb.add_option("--commit", options.commit, "commit that was measured (default: the program's hash in the record)")
      ->type_name("NAME");
  verb.add_option("--date", options.date, "the commit's date, such as 2026-11-29T12:33:53Z (default: the record's)")
      ->type_name("DATE");
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", options.file, "file of the history; made when it does not exist")
      ->capture_default_str();
}

void add_show_verb(CLI::App& verb, HistoryOptions& options) {
  begin_option_group(verb, input_group);
  verb.add_option("history", options.file, "file of the history")->required();
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", options.page, "page to write")->capture_default_str();
}

void add_comment_verb(CLI::App& verb, HistoryOptions& options) {
  begin_option_group(verb, input_group);
  verb.add_option("history", options.file, "file of the history")->required();
  verb.add_option("--base", options.base, "commit to compare with, or its beginning (default: the one before the head)")
      ->type_name("NAME");
  verb.add_option("--head", options.head, "commit to comment on (default: the newest)")->type_name("NAME");
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", options.comment,
                  "comment to write, as Markdown; pictures go to NAME-pictures beside it")
      ->capture_default_str();
  verb.add_option("--pictures", options.pictures, "pictures to show at most, those that differ most")
      ->check(CLI::Range(0, 100))
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--picture-url", options.picture_url, "address before the pictures' names, where they are uploaded")
      ->type_name("URL")
      ->check([](const std::string& url) {
        return url.find_first_of(" \"'<>|\n\r\t") == std::string::npos ? std::string() : "is no address";
      });
  verb.add_flag("--fail", options.fail, "exit with 1 where something is worse");
}

}  // namespace

void add_history_verb(CLI::App& program, int& exit_code) {
  CLI::App* verb = add_verb(
      program, {.name = "history",
                .group = judge_group,
                .purpose = "Keep records by commit, find the commit of a step, comment on pull requests",
                .examples = {"photonproof history add out/first-light/results.json --commit 53c5131 -o history.db",
                             "photonproof history show history.db -o history.html",
                             "photonproof history comment history.db --base 53c5131 -o comment.md"},
                .exit_codes = {done, {1, "comment --fail: something is worse"}, bad_input, internal_error}});
  verb->require_subcommand(1);
  const auto options = std::make_shared<HistoryOptions>();
  CLI::App* add = verb->add_subcommand("add", "Add records of bench and gate to a history");
  add_add_verb(*add, *options);
  add->callback([options] { run_add(*options); });
  CLI::App* show = verb->add_subcommand("show", "Print the last step of each series, and write a page");
  add_show_verb(*show, *options);
  show->callback([options] { run_show(*options); });
  CLI::App* comment = verb->add_subcommand("comment", "Write what a commit changed as a comment for a pull request");
  add_comment_verb(*comment, *options);
  comment->callback([options, &exit_code] { exit_code = run_comment(*options); });
}

}  // namespace photonproof::inline harness_verbs
