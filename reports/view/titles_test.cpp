#include "reports/view/titles.h"

#include <gtest/gtest.h>

#include "reports/view/test_sample_results.h"
#include "reports/view/view.h"

namespace photonproof::reports::inline reports_view {
namespace {

TEST(Titles, stand_in_place_of_names_everywhere_in_the_record) {
  Results record = sample_conclusions();
  record.scenes[0].title = "A box";
  const Results results = titled(record);
  EXPECT_EQ(results.engines[0].name, "photon mapper");
  EXPECT_EQ(results.engines[0].title, "photon");
  EXPECT_EQ(results.scenes[0].name, "A box");
  for (std::size_t i = 0; i < record.results.size(); ++i) {
    const auto expected = [](const std::string& name, const std::string& of, const std::string& title) {
      return name == of ? title : name;
    };
    const Cell &before = record.results[i].cell, &after = results.results[i].cell;
    EXPECT_EQ(after.scene, expected(before.scene, "box", "A box"));
    if (before.engine == "photon") {
      EXPECT_EQ(after.engine, "photon mapper");
    }
    if (before.engine == "povray") {
      EXPECT_EQ(after.engine, "POV-Ray");
    }
  }
  const auto holds_no_name = [](const std::string& text) { return text != "photon" && text != "povray"; };
  for (const GateRecord& gate : results.gates) EXPECT_TRUE(holds_no_name(gate.engine));
  for (const ChangeRecord& change : results.changes) EXPECT_TRUE(holds_no_name(change.engine));
  for (const Convergence& curve : results.convergence) EXPECT_TRUE(holds_no_name(curve.engine));
  for (const RaceRecord& race : results.races) {
    for (const RaceRecord::Time& time : race.times) EXPECT_TRUE(holds_no_name(time.engine));
    for (const RaceRecord::Error& error : race.errors) EXPECT_TRUE(holds_no_name(error.engine));
    EXPECT_NE(race.scene, "box");
  }
  // The scene's reference is found by the label of its cell.
  EXPECT_EQ(results.scenes[0].reference_label.empty(), record.scenes[0].reference_label.empty());
  EXPECT_EQ(results.find(results.scenes[0].reference_label) == nullptr,
            record.find(record.scenes[0].reference_label) == nullptr);
  EXPECT_EQ(arrange(results).scenes.size(), arrange(record).scenes.size());
}

TEST(Titles, that_are_used_twice_or_are_anothers_name_do_not_replace_names) {
  Results record;
  record.engines = {{"a", "photonproof path tracer", "1"},
                    {"b", "path tracer", "1"},
                    {"c", "d", "1"},
                    {"d", "other", "1"},
                    {"e", "e", "1"},
                    {"f", "", "1"}};
  const Results results = titled(record);
  std::vector<std::string> names;
  for (const EngineRecord& engine : results.engines) names.push_back(engine.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "other", "e", "f"}));
  EXPECT_EQ(results.engines[0].title, "photonproof path tracer");
}

TEST(Titles, of_a_record_without_any_change_nothing) {
  Results record = sample_conclusions();
  for (EngineRecord& engine : record.engines) engine.title.clear();
  const Results results = titled(record);
  EXPECT_EQ(results.races, record.races);
  EXPECT_EQ(results.gates, record.gates);
  EXPECT_EQ(results.convergence, record.convergence);
}

}  // namespace
}  // namespace photonproof::reports::inline reports_view
