// The --help of the program and of every verb: groups, examples that parse, exit codes, short texts; and the hints of
// messages about unknown names.

#include "harness/verbs/program/whole_program.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "harness/verbs/povray_arguments.h"
#include "harness/verbs/usage/name_hints.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"

namespace photonproof::inline harness_verbs_program {
namespace {

constexpr std::size_t page_width = 100, longest_option_text = 100, longest_purpose = 87;
const std::string scene = "scenes/library/cornell/scene.xml";

/// Thrown after a command line is parsed, so that no verb runs.
struct Parsed {};

class WholeProgram : public testing::Test {
 protected:
  WholeProgram() {
    make_whole_program(program_, exit_code_);
    program_.parse_complete_callback([] { throw Parsed{}; });
  }

  std::vector<CLI::App*> verbs() {
    return program_.get_subcommands([](const CLI::App* verb) { return !verb->get_group().empty(); });
  }
  /// The verbs and their subcommands.
  std::vector<CLI::App*> apps() {
    std::vector<CLI::App*> all = verbs();
    for (CLI::App* verb : verbs())
      for (CLI::App* sub : verb->get_subcommands({})) all.push_back(sub);
    return all;
  }
  /// The message about the arguments; empty where they are right.
  std::string complaint(std::vector<std::string> arguments) {
    std::ranges::reverse(arguments);  // CLI11 takes them from the back
    try {
      program_.parse(arguments);
    } catch (const Parsed&) {
      return "";
    } catch (const CLI::ParseError& error) {
      return complaint_about(program_, error);
    }
    return "nothing was parsed";
  }

  CLI::App program_;
  int exit_code_ = 0;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A command line's words; quotes hold one together.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  std::istringstream stream(command);
  for (std::string word; stream >> std::quoted(word);) words.push_back(word);
  return words;
}

bool names_its_codes(const std::string& help) {
  const std::size_t table = help.find("\nExit codes:\n  0    ");
  return table != std::string::npos && help.find("\n  2    ", table) != std::string::npos;
}

TEST_F(WholeProgram, has_every_verb_in_a_group_with_one_line_each) {
  const std::string help = program_.help();
  for (const char* group : {"\nStart:\n", "\nRender:\n", "\nMeasure:\n", "\nJudge:\n", "\nMaintain:\n"})
    EXPECT_NE(help.find(group), std::string::npos) << group;
  EXPECT_EQ(help.find("Subcommands"), std::string::npos) << help;
  EXPECT_EQ(verbs().size(), 24u);
  for (const CLI::App* verb : verbs()) {
    const std::string purpose = lines_of(verb->get_description()).at(0);
    EXPECT_LE(purpose.size(), longest_purpose) << purpose;
    const std::string name = verb->get_name();
    const std::string gap = name.size() < 11 ? std::string(11 - name.size(), ' ') : "\n" + std::string(13, ' ');
    EXPECT_NE(help.find("\n  " + name + gap + purpose + "\n"), std::string::npos) << help;
  }
  EXPECT_TRUE(names_its_codes(help)) << help;
}

TEST_F(WholeProgram, every_help_has_an_example_exit_codes_and_fits_the_page) {
  for (const CLI::App* verb : verbs()) {
    const std::size_t examples = examples_of(*verb).size();
    EXPECT_TRUE(examples >= 1 && examples <= 3) << verb->get_name();
    const std::string help = verb->help();
    const std::size_t page = help.find("docs/verbs/");
    ASSERT_NE(page, std::string::npos) << help;
    const std::string name = help.substr(page, help.find(".md", page) + 3 - page);
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(PHOTONPROOF_SOURCE_DIR) / name)) << name;
  }
  std::vector<CLI::App*> all = apps();
  all.push_back(&program_);
  for (const CLI::App* app : all) {
    const std::string help = app->help();
    EXPECT_TRUE(names_its_codes(help)) << help;
    for (const std::string& line : lines_of(help))
      if (!line.starts_with("Example: ")) {
        EXPECT_LE(line.size(), page_width) << line;
      }
  }
}

TEST_F(WholeProgram, every_option_is_in_a_group_with_a_short_text) {
  for (const CLI::App* app : apps())
    for (const CLI::Option* option : app->get_options({})) {
      const std::string text = option->get_description(), name = app->get_name() + " " + option->get_name();
      EXPECT_FALSE(text.empty()) << name;
      EXPECT_LE(text.size(), longest_option_text) << name << ": " << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << name;
      EXPECT_EQ(option->get_group() == "Options", option == app->get_help_ptr()) << name;
    }
}

TEST_F(WholeProgram, every_example_parses_and_names_files_that_exist) {
  std::vector<std::string> examples = examples_of(program_);
  EXPECT_FALSE(examples.empty());
  for (const CLI::App* verb : verbs())
    for (const std::string& example : examples_of(*verb)) {
      EXPECT_TRUE(example.starts_with("photonproof " + verb->get_name())) << example;
      examples.push_back(example);
    }
  for (const std::string& example : examples) {
    std::vector<std::string> words = words_of(example);
    ASSERT_EQ(words.at(0), "photonproof") << example;
    words.erase(words.begin());
    EXPECT_EQ(complaint(words), "") << example;
    for (const std::string& word : words)
      if (word.starts_with("scenes/") || word.starts_with("harness/")) {
        EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(PHOTONPROOF_SOURCE_DIR) / word)) << example;
      }
  }
}

TEST_F(WholeProgram, hints_at_the_nearest_verb_option_and_value) {
  EXPECT_EQ(complaint({"rendr", scene}), "unknown verb 'rendr' (did you mean 'render'?); photonproof --help lists all");
  EXPECT_EQ(complaint({"paint"}), "unknown verb 'paint'; photonproof --help lists all");
  EXPECT_EQ(complaint({"--verson"}),
            "unknown option '--verson' (did you mean '--version'?); photonproof --help lists all");
  EXPECT_EQ(complaint({"render", scene, "--integratr", "path"}),
            "unknown option '--integratr' (did you mean '--integrator'?); photonproof render --help lists all");
  EXPECT_EQ(complaint({"render", scene, "--integratr=path"}),
            "unknown option '--integratr' (did you mean '--integrator'?); photonproof render --help lists all");
  EXPECT_EQ(complaint({"generate", "milion", "--triangles", "1e6"}),
            "unknown subcommand 'milion' (did you mean 'million'?); photonproof generate --help lists all");
  EXPECT_EQ(
      complaint({"generate", "million", "--triangels", "1e6"}),
      "unknown option '--triangels' (did you mean '--triangles'?); photonproof generate million --help lists all");
  EXPECT_EQ(complaint({"render", scene, "--sampler", "sobl"}),
            "--sampler: unknown 'sobl' (did you mean 'sobol'?), expected sobol or independent; "
            "photonproof render --help lists all options");
}

TEST_F(WholeProgram, hints_at_an_unknown_option_before_what_is_missing_because_of_it) {
  EXPECT_EQ(complaint({"povray", scene, "--outptu", "a.exr"}),
            "unknown option '--outptu' (did you mean '--output'?); photonproof povray --help lists all");
}

TEST_F(WholeProgram, says_in_one_line_what_is_missing) {
  EXPECT_EQ(complaint({}), "expected a verb; photonproof --help lists all");
  EXPECT_EQ(
      complaint({"generate"}),
      "photonproof generate: expected million, many-lights, assets or showcase; photonproof generate --help lists all");
  EXPECT_EQ(complaint({"povray", scene}), "--output is required; photonproof povray --help lists all options");
}

TEST_F(WholeProgram, takes_qualities_by_name_and_by_number) {
  EXPECT_EQ(povray_quality_digit("draft"), "1");
  EXPECT_EQ(povray_quality_digit("medium"), "2");
  EXPECT_EQ(povray_quality_digit("high"), "3");
  EXPECT_EQ(povray_quality_digit("paths"), "4");
  for (const char* digit : {"1", "2", "3", "4"}) EXPECT_EQ(povray_quality_digit(digit), digit);
  EXPECT_EQ(complaint({"povray", scene, "-o", "a.exr", "--quality", "high"}), "");
  EXPECT_EQ(program_.get_subcommand("povray")->get_option("--quality")->as<int>(), 3);
  EXPECT_EQ(complaint({"export", scene, "-o", "a.pov", "--quality", "4"}), "");
  for (const char* wrong : {"0", "5", "1.5", "", "High"})
    EXPECT_NE(complaint({"povray", scene, "-o", "a.exr", "--quality", wrong}), "") << wrong;
  EXPECT_EQ(
      complaint({"povray", scene, "-o", "a.exr", "--quality", "hihg"}),
      "--quality: 'hihg' is not a quality (did you mean 'high'?), expected draft, medium, high or paths, or 1 to 4; "
      "photonproof povray --help lists all options");
  EXPECT_NE(program_.get_subcommand("povray")->help().find("2 medium"), std::string::npos);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_program
