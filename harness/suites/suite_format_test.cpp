// Checks that docs/formats/suite.md lists exactly the keys that the readers of suites take, and that its examples load.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "harness/gates/gate_suite.h"
#include "harness/metrics/metric_rows.h"
#include "harness/suites/engine_command.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_suites {
namespace {

std::string page() { return read_file(PHOTONPROOF_SOURCE_DIR "/docs/formats/suite.md"); }

/// The text under the heading, up to the next heading.
std::string section(const std::string& heading) {
  const std::string text = page(), start = "\n## " + heading + "\n";
  const std::size_t from = text.find(start);
  EXPECT_NE(from, std::string::npos) << heading;
  if (from == std::string::npos) return "";
  return text.substr(from + start.size(), text.find("\n## ", from + start.size()) - from - start.size());
}

/// The first cells of the first table of a section, without their backquotes.
std::set<std::string> documented_keys(const std::string& heading) {
  std::set<std::string> keys;
  std::istringstream lines(section(heading));
  bool in_table = false;
  for (std::string line; std::getline(lines, line);) {
    const bool is_row = line.rfind("| ", 0) == 0 || line.rfind("|-", 0) == 0;
    if (in_table && !is_row) break;
    in_table = is_row;
    if (line.rfind("| `", 0) == 0) keys.insert(line.substr(3, line.find('`', 3) - 3));
  }
  return keys;
}

class SuiteFormat : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    for (const char* scene : {"cornell", "furnace"}) {
      std::filesystem::create_directories(folder_ / scene);
      put(std::string(scene) + "/scene.xml", "");
      put(std::string(scene) + "/scene.whitted", "");
    }
  }

  /// The keys that a reader accepts in the table where it finds the unknown key "unknown".
  template <class Read>
  std::set<std::string> keys_of_message(const std::string& text, const Read& read) const {
    put("s.toml", text);
    const std::string message = input_error_of([&] { read(folder_ / "s.toml"); });
    const std::string start = "unknown key 'unknown'; known here: ";
    const std::size_t from = message.find(start);
    EXPECT_NE(from, std::string::npos) << message;
    if (from == std::string::npos) return {};
    std::set<std::string> keys;
    std::istringstream words(message.substr(from + start.size(), message.find('\n', from) - from - start.size()));
    for (std::string key; std::getline(words, key, ',');) keys.insert(key.substr(key.front() == ' ' ? 1 : 0));
    return keys;
  }
};

struct Part {
  const char* heading;
  const char* after;  ///< the line of a suite after which an unknown key stands in this table
};

std::string with_unknown(std::string text, const std::string& after) {
  const std::size_t at = text.rfind(after);
  EXPECT_NE(at, std::string::npos) << after;
  return text.insert(at + after.size(), "unknown = 1\n");
}

constexpr const char* parameters_heading = "Parameters of a gate's metric";

constexpr const char* bench_text = R"toml(title = 't'
name = 'n'
[limits]
seconds = 1
[bench]
control = 'path'
[[engine]]
name = 'mine'
title = 'm'
command = ['mine', '{scene}', '{output}']
budgets = ['spp']
trust = 'external'
[[scene]]
name = 'cornell'
path = 'cornell/scene.xml'
width = 8
height = 8
exposure = 0
reference = {engine = 'path', budget = 'spp=9', seed = 0}
[[run]]
engine = 'path'
budgets = ['spp=1']
seeds = [1]
)toml";

constexpr const char* gate_text = R"toml(title = 't'
name = 'n'
[limits]
seconds = 1
[[scene]]
name = 'cornell'
path = 'cornell/scene.xml'
width = 8
height = 8
exposure = 0
[[gate]]
scene = 'cornell'
engine = 'path'
budget = 'spp=1'
metric = 'agreement'
bound = 0.5
[[unpromised]]
planted = 'hole'
why = 'w'
)toml";

// A key that only the reader or only the page has fails here.
TEST_F(SuiteFormat, every_key_that_is_read_is_in_the_page_and_no_other) {
  std::map<std::string, std::set<std::string>> read;
  const auto add = [&](const std::string& heading, const std::set<std::string>& keys) {
    read[heading].insert(keys.begin(), keys.end());
  };
  for (const Part& part : {Part{"Keys of the file", "name = 'n'\n"},
                           {"`[limits]`", "seconds = 1\n"},
                           {"`[bench]`", "control = 'path'\n"},
                           {"`[[engine]]`", "trust = 'external'\n"},
                           {"`[[scene]]`", "exposure = 0\n"},
                           {"`[[run]]`", "seeds = [1]\n"}})
    add(part.heading, keys_of_message(with_unknown(bench_text, part.after), read_suite));
  for (const Part& part : {Part{"Keys of the file", "name = 'n'\n"},
                           {"`[limits]`", "seconds = 1\n"},
                           {"`[[scene]]`", "exposure = 0\n"},
                           {"`[[gate]]`", "bound = 0.5\n"},
                           {"`[[unpromised]]`", "why = 'w'\n"}})
    add(part.heading, keys_of_message(with_unknown(gate_text, part.after), read_gate_suite));
  ASSERT_EQ(read.size(), 8u);
  for (auto& [heading, keys] : read) {
    std::set<std::string> documented = documented_keys(heading);
    for (const auto& [one, many] : {std::pair{"engine", "engines"}, {"scene", "scenes"}})
      if (documented.count(one) != 0 &&
          section(heading).find("`" + std::string(many) + "` is the same") != std::string::npos)
        documented.insert(many);
    if (heading == "`[[gate]]`") documented.merge(documented_keys(parameters_heading));
    EXPECT_EQ(documented, keys) << heading;
  }
}

TEST_F(SuiteFormat, page_has_the_table_of_the_metrics_parameters_that_gates_go_by) {
  std::string table = "| key | type | without it | of | meaning | example |\n|---|---|---|---|---|---|\n";
  for (const MetricParameter& parameter : metric_parameters) {
    const std::string range = range_text(parameter);
    const std::string type = number_count(parameter) == 1 ? "number" : "array of numbers";
    const std::string without = parameter.in_gates  ? parameter.in_gates
                                : parameter.without ? parameter.without
                                                    : value_text(parameter, {});
    table += "| `" + std::string(parameter.name) + "` | " + type + (range.empty() ? "" : ", " + range) + " | " +
             without + " | " + metrics_with(parameter) + " | " + parameter.meaning + " | `" + parameter.example +
             "` |\n";
  }
  EXPECT_TRUE(section(parameters_heading).ends_with("\n" + table)) << "put this in the page:\n" << table;
  for (const std::string& key : documented_keys("`[[gate]]`"))
    EXPECT_EQ(std::ranges::count(metric_parameters, key, &MetricParameter::name), 0) << key << " is a key already";
}

TEST_F(SuiteFormat, every_metric_takes_the_examples_of_its_parameters) {
  int taken = 0;
  for (const MetricParameter& parameter : metric_parameters)
    for (const MetricRow& row : metric_rows()) {
      if (!has_parameter(row, parameter)) continue;
      std::string text = gate_text;
      for (const auto& [old, fresh] :
           {std::pair{std::string("'agreement'"), "'" + std::string(row.name) + "'"},
            {"width = 8", "width = 16"},
            {"height = 8", "height = 16"},
            {"bound = 0.5\n", "bound = 0.5\n" + (parameter.name + (" = " + std::string(parameter.example))) + "\n"}})
        text.replace(text.find(old), old.size(), fresh);
      put("s.toml", text);
      EXPECT_EQ(input_error_of([&] {
                  EXPECT_EQ(read_gate_suite(folder_ / "s.toml").gates.at(0).parameters.size(), 1u);
                  ++taken;
                }),
                "no error");
    }
  EXPECT_GT(taken, 0);
}

TEST_F(SuiteFormat, every_placeholder_is_in_the_page) {
  const std::string message = command_problem({"x", "{nothing_like_it}"}, CommandUse::render).value_or("");
  std::istringstream words(message.substr(message.find("known: ") + 7));
  int count = 0;
  for (std::string placeholder; words >> placeholder; ++count)
    EXPECT_NE(section("`[[engine]]`").find("`" + placeholder + "`"), std::string::npos) << placeholder;
  EXPECT_EQ(count, 12);
}

TEST_F(SuiteFormat, engines_that_need_no_row_are_in_the_page) {
  for (const Engine& engine : builtin_engines())
    EXPECT_NE(section("`[[engine]]`").find("`" + engine.name + "`"), std::string::npos) << engine.name;
}

TEST_F(SuiteFormat, the_examples_of_the_page_load) {
  std::vector<std::string> examples;
  const std::string text = page();
  for (std::size_t at = text.find("```toml\n"); at != std::string::npos; at = text.find("```toml\n", at + 1)) {
    const std::size_t from = at + 8;
    examples.push_back(text.substr(from, text.find("```", from) - from));
  }
  ASSERT_EQ(examples.size(), 2u);
  put("bench.toml", examples[0]);
  EXPECT_EQ(input_error_of([&] { EXPECT_EQ(read_suite(folder_ / "bench.toml").cells.size(), 30u); }), "no error");
  put("gate.toml", examples[1]);
  const auto names = [&] {
    std::vector<std::string> all;
    for (const Gate& gate : read_gate_suite(folder_ / "gate.toml").gates) all.push_back(gate.name);
    return all;
  };
  EXPECT_EQ(input_error_of([&] {
              EXPECT_EQ(names(), (std::vector<std::string>{"cornell/path/agreement", "furnace/path/agreement",
                                                           "looks alike", "looks alike in the dark"}));
            }),
            "no error");
  // Every key of these tables must occur in some example.
  for (const char* heading : {"Keys of the file", "`[limits]`", "`[bench]`", "`[[engine]]`", "`[[scene]]`", "`[[run]]`",
                              "`[[gate]]`", "`[[unpromised]]`"})
    for (const std::string& key : documented_keys(heading))
      EXPECT_TRUE(std::ranges::any_of(examples,
                                      [&](const std::string& example) {
                                        return example.find("\n" + key + " = ") != std::string::npos ||
                                               example.rfind(key + " = ", 0) == 0 ||
                                               example.find("[" + key + "]") != std::string::npos;
                                      }))
          << heading << " " << key;
}

}  // namespace
}  // namespace photonproof::inline harness_suites
