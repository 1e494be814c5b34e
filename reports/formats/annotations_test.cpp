#include "reports/formats/annotations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace photonproof::reports::inline reports_formats {
namespace {

GateRecord gate_with(GateVerdict verdict, const std::string& name, const std::string& sentence) {
  GateRecord gate;
  gate.name = name;
  gate.scene = "box";
  gate.engine = "path";
  gate.verdict = verdict;
  gate.sentence = sentence;
  return gate;
}

std::string annotations_of(const std::vector<GateRecord>& gates) {
  Results results;
  results.gates = gates;
  return github_annotations(arrange(results), "ci/my,gates.toml");
}

TEST(Annotations, tell_failures_first_and_escape_what_ends_a_command) {
  EXPECT_EQ(
      annotations_of({gate_with(GateVerdict::inconclusive, "a", "noise"), gate_with(GateVerdict::pass, "b", "right"),
                      gate_with(GateVerdict::fail, "box:c", "-3 %, and\nmore: red")}),
      "::error file=ci/my%2Cgates.toml,title=gate box%3Ac::-3 %25, and%0Amore: red\n"
      "::warning file=ci/my%2Cgates.toml,title=gate a::noise\n");
  EXPECT_EQ(annotations_of({gate_with(GateVerdict::pass, "b", "right")}), "");
}

TEST(Annotations, are_ten_at_most_of_which_the_last_counts_the_rest) {
  std::vector<GateRecord> gates;
  for (int i = 0; i < 10; ++i) gates.push_back(gate_with(GateVerdict::fail, std::to_string(i), "dark"));
  EXPECT_EQ(annotations_of(gates).find("notice"), std::string::npos);
  gates.push_back(gate_with(GateVerdict::inconclusive, "open", "noise"));
  const std::string eleven = annotations_of(gates);
  EXPECT_EQ(std::ranges::count(eleven, '\n'), 10);
  EXPECT_NE(
      eleven.find("::notice file=ci/my%2Cgates.toml,title=gates::2 more gates do not pass; the report has them all\n"),
      std::string::npos);
}

}  // namespace
}  // namespace photonproof::reports::inline reports_formats
