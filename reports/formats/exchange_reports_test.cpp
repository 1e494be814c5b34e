#include "reports/formats/exchange_reports.h"

#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "reports/formats/formats.h"
#include "reports/view/test_hostile_results.h"
#include "scenes/base/process.h"

namespace photonproof::inline reports_formats {
namespace {

using namespace reports;
using nlohmann::json;

std::string written(const char* format, const Results& results) {
  const TemporaryFolder folder;
  report_format(format).write(results, folder.path(), folder.path() / "out");
  return file_text(folder.path() / "out");
}

/// RFC 4180: rows of cells.
std::vector<std::vector<std::string>> parsed_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& cell = rows.back().back();
    if (quoted) {
      if (text[i] != '"') {
        cell += text[i];
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cell += text[i++];
      } else {
        quoted = false;
      }
    } else if (text[i] == '"') {
      quoted = true;
    } else if (text[i] == ',') {
      rows.back().emplace_back();
    } else if (text[i] == '\r' && text[i + 1] == '\n') {
      rows.push_back({""});
      ++i;
    } else {
      cell += text[i];
    }
  }
  rows.pop_back();  // the text after the last line end
  return rows;
}

TEST(CsvReport, reads_like_its_snapshot) { expect_snapshot("sample.csv", written("csv", sample_conclusions())); }

TEST(CsvReport, every_row_has_every_column_and_numbers_come_back_exactly) {
  Results results = hostile("a,\"b\"\r\n=1+1");
  results.results[1].metrics = {{"relmse", 0.1 + 0.2, ""}};
  const auto rows = parsed_csv(written("csv", results));
  bool found = false;
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 13u) << row.front();
    if (row[0] == "cell" && row[7] == "relmse") found = found || std::stod(row[8]) == 0.1 + 0.2;
  }
  EXPECT_TRUE(found);
  EXPECT_GT(rows.size(), 40u);
}

TEST(WideCsvReport, reads_like_its_snapshot) {
  expect_snapshot("sample.wide.csv", written("csv-wide", sample_conclusions()));
}

TEST(WideCsvReport, every_row_has_every_column_and_budgets_have_their_mean) {
  Results results = sample_results();
  results.results.push_back(finished("box", "photon", {"photons", 2000}, 2, 0.1));  // beside seed 1 with 0.05
  const auto rows = parsed_csv(written("csv-wide", results));
  ASSERT_EQ(rows.size(), 1u + 4u);  // photon's two budgets of box, povray's finished one, photon's of hole
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  const auto column = std::ranges::find(rows[0], "relmse") - rows[0].begin();
  EXPECT_EQ(rows[1][3], "2000");
  EXPECT_EQ(rows[1][4], "2");
  EXPECT_NEAR(std::stod(rows[1][static_cast<std::size_t>(column)]), 0.075, 1e-12);
}

TEST(CsvReport, no_text_is_a_spreadsheets_formula) {
  for (const auto& row : parsed_csv(written("csv", hostile("=HYPERLINK(1)")))) {
    for (const std::size_t text : {0u, 1u, 2u, 3u, 4u, 7u, 11u, 12u}) {
      EXPECT_TRUE(row[text].empty() || std::string("=+-@").find(row[text].front()) == std::string::npos) << row[text];
    }
  }
}

TEST(JunitReport, reads_like_its_snapshot) {
  expect_snapshot("sample.junit.xml", written("junit", sample_conclusions()));
}

/// Rules of Jenkins' junit-10.xsd: for each element its attributes (required ones with '!') and its children.
struct Rule {
  std::set<std::string> attributes, children;
};
const std::map<std::string, Rule>& junit_rules() {
  static const std::set<std::string> outcome{"type", "message"};
  static const std::map<std::string, Rule> rules{
      {"testsuites", {{"name", "time", "tests", "failures", "errors"}, {"testsuite"}}},
      {"testsuite",
       {{"!name", "!tests", "!failures", "!errors", "skipped", "time", "timestamp", "hostname", "id", "package"},
        {"testsuite", "properties", "testcase", "system-out", "system-err"}}},
      {"testcase",
       {{"!name", "time", "classname", "group"}, {"skipped", "error", "failure", "system-out", "system-err"}}},
      {"properties", {{}, {"property"}}},
      {"property", {{"!name", "!value"}, {}}},
      {"failure", {outcome, {}}},
      {"error", {outcome, {}}},
      {"skipped", {outcome, {}}},
      {"system-out", {{}, {}}},
  };
  return rules;
}

void expect_valid(const pugi::xml_node& node) {
  const auto rule = junit_rules().find(node.name());
  ASSERT_NE(rule, junit_rules().end()) << node.name();
  for (const pugi::xml_attribute attribute : node.attributes()) {
    const std::string name = attribute.name();
    EXPECT_TRUE(rule->second.attributes.contains(name) || rule->second.attributes.contains("!" + name)) << name;
    if (name == "time") {
      EXPECT_TRUE(std::regex_match(attribute.value(), std::regex("[0-9]+\\.[0-9]*"))) << name;
    }
  }
  for (const std::string& name : rule->second.attributes) {
    EXPECT_TRUE(name[0] != '!' || node.attribute(name.c_str() + 1)) << node.name() << " lacks " << name;
  }
  for (const pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element) continue;
    EXPECT_TRUE(rule->second.children.contains(child.name())) << child.name() << " in " << node.name();
    expect_valid(child);
  }
}

TEST(JunitReport, follows_the_schema_whatever_the_texts_are) {
  for (const std::string& evil :
       {std::string("]]><x a='\"'>&\x01\xff"), std::string("\uFFFE \uFFFF"), std::string(symbols), std::string()}) {
    const std::string text = written("junit", hostile(evil));
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(text.c_str())) << text.substr(0, 500);
    expect_valid(document.document_element());
  }
}

/// Validates a report against the schema by xmllint, as users' tools do, and returns its last message if it is refused.
std::string refused_by_schema(const std::string& report) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "junit.xml").string();
  std::ofstream(file, std::ios::binary) << report;
  const ProcessOutcome outcome =
      run_process({"xmllint", "--noout", "--schema", PHOTONPROOF_SOURCE_DIR "/reports/junit.xsd", file});
  return outcome.ok() ? "" : outcome.sentence() + ": " + outcome.standard_error;
}

bool has_xmllint() { return run_process({"xmllint", "--version"}).ok(); }

TEST(JunitReport, xmllint_finds_it_valid) {
  if (!has_xmllint()) GTEST_SKIP() << "xmllint is not here (Debian: libxml2-utils)";
  EXPECT_EQ(refused_by_schema(written("junit", sample_conclusions())), "");
  EXPECT_EQ(refused_by_schema(written("junit", Results{})), "");
  for (const std::string& evil : {std::string("]]><x a='\"'>&\x01\xff"), std::string()}) {
    EXPECT_EQ(refused_by_schema(written("junit", hostile(evil))), "");
  }
}

// xmllint returns status 3 for a well-formed document that does not follow the schema.
TEST(JunitReport, xmllint_refuses_an_attribute_in_the_wrong_place) {
  if (!has_xmllint()) GTEST_SKIP() << "xmllint is not here (Debian: libxml2-utils)";
  const std::string good = written("junit", sample_conclusions());
  const std::pair<const char*, const char*> misplaced[] = {
      {"<testsuites ", "<testsuites skipped=\"0\" "}, {"<testsuite ", "<testsuite classname=\"a\" "},
      {"<testcase ", "<testcase tests=\"1\" "},       {"<property ", "<property time=\"1.0\" "},
      {"<failure ", "<failure name=\"a\" "},          {"<system-out>", "<system-out type=\"a\">"}};
  for (const auto& [from, to] : misplaced) {
    std::string bad = good;
    bad.replace(bad.find(from), std::string_view(from).size(), to);
    const std::string words = refused_by_schema(bad);
    EXPECT_TRUE(words.starts_with("exited with 3")) << to << ": " << words;
    EXPECT_NE(words.find("is not allowed"), std::string::npos) << to << ": " << words;
  }
  std::string bad = good;
  bad.replace(bad.find(" classname="), std::string_view(" classname=").size(), " class=");
  EXPECT_NE(refused_by_schema(bad), "");
}

TEST(JunitReport, says_what_a_gate_would_have_seen_and_where_it_can_only_notice_changes) {
  Results results = sample_conclusions();
  results.gates[0].would_see = 0.013;
  results.gates[0].would_see_in_a_block = 0.15;
  results.gates[0].regression_only = "the reference is by photonmapper, whose sampling is the engine's";
  const std::string text = written("junit", results);
  const std::string name = "<property name=\"" + results.gates[0].name + ": ";
  EXPECT_EQ(count(text, name + "would see\" value=\"0.013\""), 1u);
  EXPECT_EQ(count(text, name + "would see in a block\" value=\"0.15\""), 1u);
  EXPECT_EQ(count(text, name + "regression only\" value=\"the reference is by photonmapper,"), 1u);
  EXPECT_EQ(count(written("junit", sample_conclusions()), "regression only"), 0u);
}

TEST(JunitReport, counts_what_failed_and_what_was_not_decided) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(written("junit", sample_conclusions()).c_str()));
  const pugi::xml_node root = document.child("testsuites");
  // Three gates, two changes and five cells without the reference. A gate fails and a change is a regression. The
  // timeout is an error, and an inconclusive gate is skipped.
  EXPECT_EQ(root.attribute("tests").as_int(), 10);
  EXPECT_EQ(root.attribute("failures").as_int(), 2);
  EXPECT_EQ(root.attribute("errors").as_int(), 1);
  EXPECT_STREQ(root.first_child().attribute("name").value(), "hole");  // the failing scene comes first
  EXPECT_EQ(root.child("testsuite").next_sibling().attribute("skipped").as_int(), 1);
  for (const pugi::xml_node suite : root.children()) {
    EXPECT_EQ(suite.attribute("tests").as_int(),
              std::distance(suite.children("testcase").begin(), suite.children("testcase").end()));
  }
  EXPECT_STREQ(root.first_child().child("testcase").child("failure").attribute("message").value(),
               "ring at the floor's contact: +6 % bias, 41 px");
}

TEST(GbenchReport, reads_like_its_snapshot) {
  expect_snapshot("sample.gbench.json", written("gbench", sample_conclusions()));
}

TEST(GbenchReport, seeds_are_repetitions_and_no_counter_hides_a_time) {
  Results results = sample_results();
  Result again = finished("box", "photon", {"photons", 20000}, 2, 0.01);
  again.counts["real_time"] = 7;
  results.results.push_back(again);
  const json all = json::parse(written("gbench", results));
  EXPECT_EQ(all.at("context").at("json_schema_version"), 1);
  std::vector<json> runs;
  for (const json& run : all.at("benchmarks")) {
    EXPECT_GT(run.at("real_time").get<double>(), 0);
    if (run.at("name") == "box/photon/photons=20000") runs.push_back(run);
  }
  EXPECT_EQ(all.at("benchmarks").size(), 6u);  // seven cells, one of them timed out
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].at("real_time"), 4500);  // 4.5 s in ms
  EXPECT_EQ(runs[0].at("repetitions"), 2);
  EXPECT_EQ(runs[1].at("repetition_index"), 1);
  EXPECT_EQ(runs[1].at("real_time"), 1250);
  EXPECT_EQ(runs[1].at("counter_real_time"), 7);
  EXPECT_EQ(runs[0].at("relmse"), 0.0125);
}

TEST(BencherReport, reads_like_its_snapshot) {
  expect_snapshot("sample.bencher.json", written("bencher", sample_conclusions()));
}

TEST(BencherReport, is_benchmarks_of_measures_of_numbers) {
  const json all = json::parse(written("bencher", hostile(std::string(2000, 'x') + "\xff\"")));
  EXPECT_GT(all.size(), 4u);
  for (const auto& [name, benchmark] : all.items()) {
    EXPECT_LE(name.size(), 1024u);
    EXPECT_FALSE(benchmark.empty());
    for (const auto& [measure, metric] : benchmark.items()) {
      EXPECT_LE(measure.size(), 64u);
      EXPECT_TRUE(metric.at("value").is_number());
      for (const auto& [key, value] : metric.items()) {
        EXPECT_TRUE(key == "value" || key == "lower_value" || key == "upper_value") << key;
      }
    }
  }
}

TEST(BencherReport, intervals_over_seeds_replace_single_cells) {
  const json all = json::parse(written("bencher", sample_conclusions()));
  EXPECT_EQ(all.at("box/photon/photons=2000").at("relmse"),
            (json{{"value", 0.05}, {"lower_value", 0.04}, {"upper_value", 0.0625}}));
  EXPECT_FALSE(all.contains("box/photon/photons=2000/seed=1"));
  EXPECT_EQ(all.at("box/povray/quality=1/seed=1").at("relmse"), (json{{"value", 0.25}}));
}

TEST(ExchangeReports, an_empty_record_is_still_a_file_of_its_kind) {
  EXPECT_EQ(parsed_csv(written("csv", Results{})).size(), 1u);
  EXPECT_EQ(json::parse(written("bencher", Results{})), json::object());
  EXPECT_TRUE(json::parse(written("gbench", Results{})).at("benchmarks").empty());
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(written("junit", Results{}).c_str()));
  expect_valid(document.document_element());
}

}  // namespace
}  // namespace photonproof::inline reports_formats
