#include "reports/stress/stress_record.h"

#include <gtest/gtest.h>

#include "reports/stress/stress_fields.h"
#include "reports/stress/stress_view.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/records/test_record.h"

namespace photonproof::inline reports_stress {
namespace {

StressRecord record_with(const std::vector<LevelOutcome>& outcomes) {
  StressRecord record;
  record.created = "2026-11-23T12:00:00Z";
  record.program = "photonproof 1";
  record.checksum = "0123";
  record.command = "photonproof stress -o out";
  StressSweep sweep;
  sweep.feature = "shape sphere";
  sweep.sweep_run = "scale up";
  sweep.engine = "path";
  sweep.measure = "10^k";
  sweep.wanted = 6;
  double height = 3;
  for (const LevelOutcome outcome : outcomes) {
    sweep.levels.push_back({height, outcome, "so", 0.01, 0.5, "", ""});
    height += 3;
  }
  record.sweeps.push_back(sweep);
  return record;
}

using enum LevelOutcome;

TEST(stress_records, read_back_as_they_were_written) {
  const ScratchFolder folder("stress-record");
  const auto file = folder.path() / "stress.json";
  write_stress_record(record_with({right, degraded, silently_wrong}), file);
  const StressRecord read = read_stress_record(file);
  ASSERT_EQ(read.sweeps.size(), 1u);
  ASSERT_EQ(read.sweeps[0].levels.size(), 3u);
  EXPECT_EQ(read.sweeps[0].levels[2].outcome, silently_wrong);
  EXPECT_EQ(read.sweeps[0].levels[1].would_see, 0.01);
  EXPECT_EQ(read.command, "photonproof stress -o out");
  EXPECT_TRUE(read.fails());
}

TEST(stress_records, have_the_schema_that_is_printed) {
  expect_schema_in<StressRecord>("reports/stress/stress.schema.json");
  expect_reader_agrees_with_schema(record_with({right, degraded, silently_wrong}));
}

TEST(stress_records, that_are_none_are_one_error) {
  const ScratchFolder folder("stress-record");
  for (const char* text : {"{", "{}", "{\"schema_version\": 2}", "[]"}) {
    write_file_atomically(folder.path() / "stress.json", text);
    EXPECT_THROW(read_stress_record(folder.path() / "stress.json"), InputError) << text;
  }
  EXPECT_FALSE(level_from_text("{\"height\": 3}"));
}

TEST(stress_records, name_no_picture_outside_of_their_folder) {
  StressLevel level{3, right, "so", 0.01, 0.5, "pictures/a.png", ""};
  EXPECT_TRUE(level_from_text(level_text(level)));
  level.picture = "../a.png";
  EXPECT_FALSE(level_from_text(level_text(level)));
  level.picture = "";
  level.expected = "/srv/a.png";
  EXPECT_FALSE(level_from_text(level_text(level)));
}

TEST(sweeps, break_at_their_first_failure) {
  const StressSweep broken = record_with({right, right, silently_wrong}).sweeps[0];
  ASSERT_NE(broken.breakdown(), nullptr);
  EXPECT_EQ(broken.breakdown()->height, 9);
  EXPECT_EQ(broken.right_up_to(), 6);
  EXPECT_TRUE(broken.reaches_wanted());
  EXPECT_EQ(reports::sweep_words(broken), "6, silently wrong at 9");
  const StressSweep ending = record_with({right, refused}).sweeps[0];
  EXPECT_EQ(ending.breakdown(), nullptr);
  EXPECT_FALSE(ending.reaches_wanted());
  EXPECT_EQ(reports::sweep_words(ending), "3, refused from 6");
  EXPECT_EQ(reports::sweep_words(record_with({right, right}).sweeps[0]), "all (6)");
}

TEST(steps_back, are_levels_that_did_better_before) {
  const StressRecord before = record_with({right, right, refused});
  EXPECT_TRUE(steps_back(before, before).empty());
  EXPECT_TRUE(steps_back(record_with({right, silently_wrong}), before).empty());
  EXPECT_EQ(steps_back(before, record_with({right, degraded, refused})).size(), 1u);
  EXPECT_EQ(steps_back(before, record_with({right, silently_wrong})).size(), 1u);
  EXPECT_TRUE(steps_back(before, record_with({right})).empty());
}

TEST(steps_back, are_seen_from_a_quick_sweep_run_that_had_the_wanted_height_alone) {
  StressRecord quick = record_with({right, right, right});
  quick.sweeps[0].levels.erase(quick.sweeps[0].levels.begin(), quick.sweeps[0].levels.begin() + 2);
  const std::vector<std::string> sentences = steps_back(quick, record_with({right, silently_wrong}));
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_EQ(sentences[0], "shape sphere, scale up, path, k = 6: right before, now silently wrong: so");
  EXPECT_EQ(steps_back(quick, record_with({right, refused})).size(), 1u);
  EXPECT_TRUE(steps_back(quick, record_with({right, right})).empty());
  EXPECT_TRUE(steps_back(record_with({right, right, right, right}), quick).empty());
  EXPECT_TRUE(steps_back(record_with({right, silently_wrong}), quick).empty());
}

TEST(stress_pages, hold_the_sweeps_and_no_markup_of_others) {
  const ScratchFolder folder("stress-page");
  StressRecord record = record_with({right, silently_wrong});
  record.sweeps[0].levels[1].sentence = "<script>alert(1)</script>";
  reports::write_stress_page(record, {"worse"}, folder.path(), folder.path() / "stress.html");
  const std::string page = read_file(folder.path() / "stress.html");
  EXPECT_NE(page.find("shape sphere"), std::string::npos);
  EXPECT_NE(page.find("worse"), std::string::npos);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
}

TEST(stress_tables, in_markdown_have_a_column_for_every_engine) {
  StressRecord record = record_with({right, silently_wrong});
  StressSweep other = record.sweeps[0];
  other.engine = "povray";
  other.levels[1].outcome = right;
  record.sweeps.push_back(other);
  EXPECT_NE(reports::stress_markdown(record).find("| shape sphere | scale up | 6 | 3, silently wrong at 6 | all (6) |"),
            std::string::npos)
      << reports::stress_markdown(record);
  // Four features share one row, with the one that ends lowest.
  for (const char* feature : {"shape cube", "shape disk", "shape plane"}) {
    StressSweep more = record_with({right, right}).sweeps[0];
    more.feature = feature;
    record.sweeps.push_back(more);
  }
  EXPECT_NE(reports::stress_markdown(record).find("| scale up | 3 (shape sphere of 4; 1 silently wrong) | 6 ("),
            std::string::npos)
      << reports::stress_markdown(record);
}

TEST(stress_tables, in_markdown_do_not_take_a_short_sweep_that_is_right_to_its_top_for_a_broken_one) {
  StressRecord record = record_with({right, right, silently_wrong});
  for (const char* feature : {"shape cube", "shape disk", "shape plane"}) {
    record.sweeps.push_back(record_with({right}).sweeps[0]);
    record.sweeps.back().feature = feature;
  }
  EXPECT_NE(reports::stress_markdown(record).find("| scale up | 6 (shape sphere of 4; 1 silently wrong) |"),
            std::string::npos)
      << reports::stress_markdown(record);
}

}  // namespace
}  // namespace photonproof::inline reports_stress
