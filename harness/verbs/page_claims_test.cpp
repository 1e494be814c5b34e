// Claims of the pages can be looked up and repeated: commands name tests, benchmarks, files and options that exist.
// Counts are those of the files that they count. The commands beside cheap claims print their figures again.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

const std::string source = PHOTONPROOF_SOURCE_DIR;

/// The pages with claims, one after the other.
std::string claims() {
  std::string text;
  for (const char* page :
       {"README.md", "CONTRIBUTING.md", "docs/evidence.md", "docs/performance.md", "docs/testing.md"})
    text += read_file(source + "/" + page) + "\n";
  return text;
}

/// Every page, one after the other.
std::string pages() {
  std::string text = claims();
  for (const auto& file : fs::recursive_directory_iterator(source + "/docs"))
    if (file.path().extension() == ".md") text += read_file(file.path()) + "\n";
  return text;
}

/// The group of every match of the pattern. In cells of tables `\|` stands for `|`.
std::vector<std::string> all(const std::string& text, const std::string& pattern, std::size_t group = 1) {
  std::vector<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i)
    found.push_back(std::regex_replace((*i)[group].str(), std::regex(R"(\\\|)"), "|"));
  return found;
}

std::size_t occurrences(const std::string& text, const std::string& pattern) { return all(text, pattern, 0).size(); }

struct ListedTest {
  std::string name;
  std::vector<std::string> command;
};

const std::vector<ListedTest>& listed_tests() {
  static const std::vector<ListedTest> tests = [] {
    // Into a file, since of a process's output only the end is kept.
    const fs::path list = fs::path(PHOTONPROOF_BUILD_DIR) / "page_claims_tests.json";
    const ProcessOutcome outcome =
        run_process({"sh", "-c", "ctest --test-dir \"$0\" --show-only=json-v1 >\"$1\"", PHOTONPROOF_BUILD_DIR, list});
    EXPECT_TRUE(outcome.ok()) << outcome.sentence() << outcome.standard_error;
    std::vector<ListedTest> found;
    const nlohmann::json document = nlohmann::json::parse(read_file(list));
    for (const nlohmann::json& test : document.at("tests"))
      found.push_back({test.at("name"), test.value("command", std::vector<std::string>{})});
    return found;
  }();
  return tests;
}

std::vector<ListedTest> tests_named(const std::string& pattern) {
  std::vector<ListedTest> found;
  const std::regex regex(pattern);
  for (const ListedTest& test : listed_tests())
    if (std::regex_search(test.name, regex)) found.push_back(test);
  return found;
}

TEST(PageClaims, every_check_that_is_named_has_tests) {
  std::vector<std::string> patterns = all(claims(), R"re(`\./check "([^"`]+)"`)re");
  const std::vector<std::string> plain = all(claims(), R"(`\./check ([^"`\s]+)`)");
  patterns.insert(patterns.end(), plain.begin(), plain.end());
  EXPECT_GT(patterns.size(), 30u);
  for (const std::string& pattern : patterns)
    EXPECT_TRUE(pattern == "NAME" || !tests_named(pattern).empty()) << "./check " << pattern;
}

TEST(PageClaims, every_benchmark_that_is_named_exists) {
  std::string benches;
  for (const char* folder : {"/renderer", "/harness"})
    for (const auto& file : fs::recursive_directory_iterator(source + folder))
      if (file.path().filename().string().ends_with("_bench.cpp")) benches += read_file(file.path());
  const std::vector<std::string> names = all(claims(), R"(`\./run --bench ([a-z_]+)`)");
  EXPECT_GE(names.size(), 4u);
  for (const std::string& name : names) EXPECT_NE(benches.find(name), std::string::npos) << name;
}

TEST(PageClaims, every_file_that_is_named_exists) {
  const std::vector<std::string> paths =
      all(claims(), R"(((?:scenes|harness|reports|renderer)/[A-Za-z0-9_./-]*[A-Za-z0-9_/]))");
  EXPECT_GT(paths.size(), 30u);
  for (const std::string& path : paths) EXPECT_TRUE(fs::exists(source + "/" + path)) << path;
}

TEST(PageClaims, every_option_that_is_used_is_one_of_its_verb) {
  std::size_t options = 0;
  for (const std::string& used : all(pages(), R"((?:^|\n|`|&& )(photonproof [a-z]+ [^`\n#&]*))")) {
    const std::string line = std::regex_replace(used, std::regex(R"(\$\([^)]*\))"), "");  // without other programs
    std::vector<std::string> command{PHOTONPROOF_BINARY, all(line, R"(^photonproof ([a-z]+))").at(0)};
    if (command.back() == "generate") command.push_back("million");
    if (command.back() == "history") command.push_back(all(line, R"(^photonproof history ([a-z]+))").at(0));
    command.push_back("--help");
    const ProcessOutcome help = run_process(command);
    ASSERT_TRUE(help.ok()) << line;
    for (const std::string& option : all(line, R"(\s(--[a-z][a-z-]*))")) {
      ++options;
      EXPECT_TRUE(std::regex_search(help.standard_output, std::regex(option + "\\b"))) << option << " of: " << line;
    }
  }
  EXPECT_GT(options, 30u);
}

TEST(PageClaims, suites_have_as_many_scenes_and_gates_as_it_says) {
  const std::string gates = read_file(source + "/harness/suites/gates.toml");
  const std::string scenes = std::to_string(occurrences(gates, R"((^|\n)\[\[scene\]\])"));
  EXPECT_NE(claims().find("| " + scenes + " scenes, "), std::string::npos) << scenes << " scenes in gates.toml";
  const std::string features = read_file(source + "/harness/suites/gates-features.toml");
  const std::string count = std::to_string(occurrences(features, R"((^|\n)\[\[scene\]\])"));
  EXPECT_TRUE(std::regex_search(claims(), std::regex("gates of every camera[^|\n]*: " + count + " scenes")))
      << count << " scenes in gates-features.toml";
  const std::vector<std::string> words{"zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"};
  const std::string first = read_file(source + "/harness/suites/first-light.toml");
  EXPECT_NE(claims().find("renders " + words.at(occurrences(first, R"((^|\n)\[\[scene\]\])")) + " scenes"),
            std::string::npos);
}

/// The row of the table whose command is this, split into its cells.
std::vector<std::string> row_of(const std::string& command) {
  for (const std::string& row : all(claims(), R"((?:^|\n)\|([^\n]*)\|(?=\n))")) {
    if (row.find("`" + command + "`") == std::string::npos) continue;
    return all(row + "|", R"(([^|]*)\|)");
  }
  return {};
}

// A figure is repeated where a number is printed that rounds to it, give or take 1.5 units of its last digit, since
// processors round differently.
TEST(PageClaims, cheap_ones_are_repeated) {
  for (const char* pattern : {"furnace_by_path", "light_point_by", "light_area_by"}) {
    const std::vector<std::string> cells = row_of("./check " + std::string(pattern));
    ASSERT_EQ(cells.size(), 4u) << pattern;
    std::string printed;
    for (const ListedTest& test : tests_named(pattern)) {
      const ProcessOutcome outcome = run_process(test.command);
      EXPECT_TRUE(outcome.ok()) << test.name << outcome.sentence();
      printed += outcome.standard_output;
    }
    std::vector<double> figures;
    for (const std::string& text : all(printed, R"(([+-]?\d+\.\d+) %)"))
      figures.push_back(std::strtod(text.c_str(), nullptr));
    const std::vector<std::string> claimed = all(cells[2], R"(([+-]?\d+\.\d+))");
    EXPECT_FALSE(claimed.empty()) << pattern;
    for (const std::string& claim : claimed) {
      const double value = std::strtod(claim.c_str(), nullptr);
      const double last_digit = std::pow(10.0, -static_cast<double>(claim.size() - claim.find('.') - 1));
      EXPECT_TRUE(std::any_of(figures.begin(), figures.end(),
                              [&](double figure) { return std::abs(figure - value) <= 1.5 * last_digit; }))
          << "a page: " << claim << " for ./check " << pattern << ", which prints\n"
          << printed;
    }
  }
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
