#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "harness/cells/folder_lock.h"
#include "harness/verbs/verbs.h"
#include "reports/record/results.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

class ReportVerb : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    Results results;
    results.suite = "tiny";
    results.created = "2026-02-03T04:05:06Z";
    results.host = {"Some CPU", "Debian 12", "Linux 6.1", 2, std::uint64_t{8} << 30};
    write_results((folder_ / "results.json").string(), results);
  }

  /// The verb's output; throws as the verb does.
  std::string run(std::vector<std::string> arguments) {
    CLI::App program;
    int exit_code = -1;
    add_report_verb(program, exit_code);
    arguments.insert(arguments.begin(), "report");
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes a vector last argument first
    testing::internal::CaptureStdout();
    try {
      program.parse(arguments);
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
    EXPECT_EQ(exit_code, 0);
    return testing::internal::GetCapturedStdout();
  }

  std::string path(const char* name) const { return (folder_ / name).string(); }
};

TEST_F(ReportVerb, writes_html_beside_the_record_unless_told_otherwise) {
  EXPECT_EQ(run({path("results.json")}), path("report.html") + "\n");
  EXPECT_NE(read_file(path("report.html")).find("<title>tiny"), std::string::npos);
}

TEST_F(ReportVerb, writes_several_formats) {
  const std::string both = path("report.html") + "\n" + path("report.md") + "\n";
  EXPECT_EQ(run({"--format", "html", "--format", "markdown", path("results.json")}), both);
  EXPECT_EQ(run({"--format", "html,markdown", path("results.json")}), both);
  EXPECT_EQ(read_file(path("report.md")).rfind("# tiny\n", 0), 0u);
}

TEST_F(ReportVerb, writes_where_it_is_told) {
  EXPECT_EQ(run({path("results.json"), "--format", "markdown", "-o", path("other.txt")}), path("other.txt") + "\n");
  EXPECT_TRUE(fs::exists(folder_ / "other.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "report.md"));
}

TEST_F(ReportVerb, says_what_it_wrote_as_json) {
  const auto json = nlohmann::json::parse(run({path("results.json"), "--json"}));
  EXPECT_EQ(json, (nlohmann::json{{"written", {{{"format", "html"}, {"file", path("report.html")}}}}}));
}

/// The summary of the InputError that `action` throws.
template <class Action>
std::string complaint(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.summary();
  }
  return "no error";
}

TEST_F(ReportVerb, one_file_cannot_hold_two_formats) {
  EXPECT_EQ(complaint([&] {
              run({path("results.json"), "--format", "html,markdown", "-o", path("x")});
            }),
            "--output: error: names one file, but more than one format is asked for");
  EXPECT_FALSE(fs::exists(folder_ / "x"));
}

TEST_F(ReportVerb, an_unknown_format_is_refused_before_anything_is_written) {
  EXPECT_EQ(complaint([&] {
              run({path("results.json"), "--format", "html,word"});
            }),
            "word: error: no such report format; there are html, markdown, csv, csv-wide, latex, "
            "pgfplots, svg, pdf, figure, junit, gbench, bencher");
  EXPECT_FALSE(fs::exists(folder_ / "report.html"));
}

TEST_F(ReportVerb, an_option_needs_a_format_that_reads_it) {
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"--methods", "columns"}, "--methods: error: needs --format latex"},
      {{"--table", "races"}, "--table: error: needs --format latex"},
      {{"--scene", "box"}, "--scene: error: needs --format pgfplots, svg, pdf, figure"},
      {{"--inset", "1", "2", "3", "4"}, "--inset: error: needs --format figure"}};
  for (const auto& [options, expected] : cases) {
    std::vector<std::string> arguments{path("results.json"), "--format", "csv"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(complaint([&] { run(arguments); }), expected);
  }
  EXPECT_FALSE(fs::exists(folder_ / "report.csv"));
}

TEST_F(ReportVerb, an_inset_is_four_numbers_and_methods_are_one_of_two_words) {
  EXPECT_THROW(run({path("results.json"), "--format", "figure", "--inset", "1", "2", "3"}), CLI::ParseError);
  EXPECT_THROW(run({path("results.json"), "--format", "latex", "--methods", "sideways"}), CLI::ParseError);
}

TEST_F(ReportVerb, a_plot_of_nothing_is_refused_and_not_written) {
  EXPECT_EQ(complaint([&] {
              run({path("results.json"), "--format", "pgfplots", "-o", path("plot.tex")});
            }),
            "the record: error: has no error above zero with a time, so there is nothing to plot");
  EXPECT_FALSE(fs::exists(folder_ / "plot.tex"));
}

TEST_F(ReportVerb, a_missing_record_is_an_input_error) {
  EXPECT_NE(complaint([&] { run({path("none.json")}); }).find("none.json"), std::string::npos);
}

TEST_F(ReportVerb, a_record_from_a_pipe_needs_a_name_for_its_report) {
  EXPECT_EQ(complaint([&] { run({"/dev/stdin"}); }),
            "/dev/stdin: error: cannot have a report beside it: name the report with -o");
}

TEST_F(ReportVerb, says_which_image_is_not_the_one_that_was_measured) {
  Results results = read_results(path("results.json"));
  Result result;
  result.key = "key";
  result.cell = {"scene", "engine", {"spp", 1}, 1};
  result.status = Status::ok;
  result.image = "image.exr";
  write_file_atomically(folder_ / "image.exr", "the image");
  result.image_checksum = file_checksum(folder_ / "image.exr");
  results.results = {result};
  write_results(path("results.json"), results);
  const std::string words = "image.exr is not the image that was measured";
  run({path("results.json")});
  EXPECT_EQ(read_file(path("report.html")).find(words), std::string::npos);
  write_file_atomically(folder_ / "image.exr", "another");
  run({path("results.json")});
  EXPECT_NE(read_file(path("report.html")).find(words), std::string::npos);
}

TEST_F(ReportVerb, never_replaces_the_record_it_reports) {
  const std::string before = read_file(path("results.json"));
  fs::create_symlink("results.json", folder_ / "link.json");
  for (const char* name : {"results.json", "link.json"}) try {
      run({path("results.json"), "--format", "gbench", "-o", path(name)});
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.summary(), path(name) + ": error: is the record that is reported, which it would replace");
    }
  EXPECT_EQ(read_file(path("results.json")), before);
}

TEST_F(ReportVerb, watch_makes_the_page_anew_while_the_run_goes_on_and_a_last_one_after_it) {
  auto lock = std::make_unique<FolderLock>(folder_);
  std::string during;
  std::jthread bench([&] {
    const auto page_has = [&](const char* text) {
      for (int i = 0; i < 400; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(25));
        if (!fs::exists(path("report.html"))) continue;
        during = read_file(path("report.html"));
        if (during.find(text) != std::string::npos) return true;
      }
      return false;
    };
    EXPECT_TRUE(page_has("<title>tiny"));
    Results results = read_results(path("results.json"));
    results.title = "second state";
    write_results(path("results.json"), results);
    EXPECT_TRUE(page_has("<title>second state"));
    EXPECT_NE(during.find("data-live=\"3\""), std::string::npos);
    results.title = "last state";
    write_results(path("results.json"), results);
    lock.reset();
  });
  EXPECT_EQ(run({path("results.json"), "--watch"}), path("report.html") + "\n");
  const std::string last = read_file(path("report.html"));
  EXPECT_NE(last.find("<title>last state"), std::string::npos);
  EXPECT_EQ(last.find("data-live=\""), std::string::npos);
}

TEST_F(ReportVerb, watch_of_a_run_that_ended_writes_the_page_once) {
  EXPECT_EQ(run({path("results.json"), "--watch"}), path("report.html") + "\n");
  EXPECT_EQ(read_file(path("report.html")).find("data-live=\""), std::string::npos);
}

TEST_F(ReportVerb, watch_needs_a_page) {
  EXPECT_EQ(complaint([&] {
              run({path("results.json"), "--watch", "--format", "csv"});
            }),
            "--watch: error: follows a run with a page: it needs --format html alone");
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
