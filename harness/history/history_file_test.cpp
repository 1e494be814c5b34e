// The database of a history: what is kept, what is refused, and files that are not what they should be.
#include "harness/history/history_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/history/history_date.h"
#include "harness/history/history_values.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_history {
namespace {

using reports::History;
using reports::HistorySeries;
using reports::Measure;
using Access = SqliteDatabase::Access;

HistoryRecord record_of(const std::string& commit, std::int64_t date, double relmse) {
  HistoryRecord record{commit + "-record", commit, date, "suite", {}, {}};
  record.values.push_back({{"suite", "cornell", "16x16", "path", "16 spp", Measure::relmse},
                           relmse,
                           Interval{relmse * 0.9, relmse * 1.1},
                           {},
                           3,
                           {}});
  return record;
}

class HistoryFileTest : public FolderTest {
 protected:
  std::string path(const std::string& name = "history.db") const { return (folder_ / name).string(); }
  void add(const HistoryRecord& record) const { HistoryFile(path(), Access::write).add(record); }
  History load() const { return HistoryFile(path(), Access::read).load(); }
  std::string error_of(const std::string& name) const {
    const std::string text = input_error_of([&] { HistoryFile(path(name), Access::read).load(); });
    return text.starts_with(path(name)) ? text.substr(path(name).size()) : text;
  }
  void run(const std::string& sql) const { SqliteDatabase(path(), Access::write).run(sql); }
};

TEST_F(HistoryFileTest, series_are_ordered_by_the_dates_of_commits) {
  add(record_of("newer", 200, 0.2));
  add(record_of("older", 100, 0.1));
  const History history = load();
  ASSERT_EQ(history.commits, (std::vector<reports::HistoryCommit>{{"older", 100}, {"newer", 200}}));
  ASSERT_EQ(history.series.size(), 1u);
  EXPECT_EQ(history.series[0].points.at(0).value, 0.1);
  EXPECT_EQ(history.series[0].points.at(1).value, 0.2);
  EXPECT_EQ(history.series[0].points[1].interval->high, 0.2 * 1.1);
  EXPECT_EQ(history.series[0].points[1].seeds, 3);
  EXPECT_EQ(history.records, 2u);
}

TEST_F(HistoryFileTest, record_is_kept_once_and_under_one_commit) {
  HistoryFile file(path(), Access::write);
  EXPECT_TRUE(file.add(record_of("a", 1, 0.1)));
  EXPECT_FALSE(file.add(record_of("a", 1, 0.1)));
  EXPECT_EQ(file.load().records, 1u);
  HistoryRecord same = record_of("a", 1, 0.1);
  same.commit = "b";
  EXPECT_EQ(input_error_of([&] { file.add(same); }), path() + ": error: has this record already, as commit a, not b");
}

TEST_F(HistoryFileTest, records_of_a_commit_are_one_point_at_their_median) {
  for (const auto& [name, value] : {std::pair("x", 0.1), std::pair("y", 0.3), std::pair("z", 0.2)}) {
    HistoryRecord record = record_of("a", 5, value);
    record.checksum = name;
    add(record);
  }
  const History history = load();
  ASSERT_EQ(history.series.at(0).points.size(), 1u);
  EXPECT_EQ(history.series[0].points[0].value, 0.2);
  // The widest of their intervals is that of 0.3: 0.03 on either side.
  EXPECT_NEAR(history.series[0].points[0].interval->low, 0.17, 1e-12);
}

// The machine was half as fast in the second session. So 2 s and 4 s with calibrations of 10 and 20 ms are the same
// time: 3 s at the median calibration of 15 ms.
TEST_F(HistoryFileTest, calibration_takes_the_machines_speed_out_of_times) {
  for (const auto& [commit, factor] : {std::pair("a", 1.0), std::pair("b", 2.0)}) {
    HistoryRecord record = record_of(commit, static_cast<std::int64_t>(factor), 0.1);
    record.values[0].key.measure = Measure::processor_seconds;
    record.values[0].value = 2 * factor;
    record.values[0].interval.reset();
    record.values[0].calibration = 0.010 * factor;
    record.values.push_back(record.values[0]);
    record.values[1].key.measure = Measure::wall_seconds;
    record.values[1].calibration.reset();
    add(record);
  }
  const History history = load();
  ASSERT_EQ(history.series.size(), 2u);
  EXPECT_TRUE(history.series[0].is_calibrated);
  EXPECT_DOUBLE_EQ(history.series[0].points[0].value, 3);
  EXPECT_DOUBLE_EQ(history.series[0].points[1].value, 3);
  EXPECT_FALSE(history.series[1].is_judged);
  EXPECT_DOUBLE_EQ(history.series[1].points[1].value, 4);
}

TEST_F(HistoryFileTest, names_with_quotes_markup_and_zeros_are_kept_as_they_are) {
  HistoryRecord record = record_of("'; DROP TABLE records; --", 1, 0.1);
  record.values[0].key.scene = std::string("<b>\"a'\0&", 9);
  add(record);
  const History history = load();
  EXPECT_EQ(history.commits[0].name, "'; DROP TABLE records; --");
  EXPECT_EQ(history.series[0].key.scene, record.values[0].key.scene);
}

TEST_F(HistoryFileTest, pictures_are_kept_once_and_of_the_newest_records) {
  HistoryFile file(path(), Access::write);
  for (int i = 0; i < records_with_pictures + 3; ++i) {
    HistoryRecord record = record_of("c" + std::to_string(i), i, 0.1);
    record.pictures.push_back({"cornell", "path", "16 spp", 18446744073709551615u, i < 2 ? "old" : "new", "bytes"});
    file.add(record);
  }
  EXPECT_TRUE(file.pictures_of("c2").empty());
  const std::vector<HistoryPicture> kept = file.pictures_of("c3");
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].png, "bytes");
  EXPECT_EQ(kept[0].seed, 18446744073709551615u);
  EXPECT_EQ(SqliteDatabase(path(), Access::read).number("SELECT count(*) FROM pictures"), 1);
  EXPECT_EQ(file.load().records, static_cast<std::size_t>(records_with_pictures + 3));
}

TEST_F(HistoryFileTest, other_files_are_one_clear_error) {
  put("text.db", std::string(4096, 'x'));
  EXPECT_EQ(error_of("text.db"), ": error: is no history of photonproof");
  EXPECT_EQ(error_of("missing.db"), ": error: cannot be opened: unable to open database file");
  SqliteDatabase(path("other.db"), Access::write).run("CREATE TABLE a(b)");
  EXPECT_EQ(error_of("other.db"), ": error: is no history of photonproof");
  EXPECT_NE(input_error_of([&] { HistoryFile(path("other.db"), Access::write); }), "no error");
  std::filesystem::create_directory(folder_ / "folder.db");
  EXPECT_NE(error_of("folder.db").find(": error: cannot be opened"), std::string::npos);
  put("empty.db", "");
  EXPECT_EQ(error_of("empty.db"), ": error: is no history of photonproof");
}

TEST_F(HistoryFileTest, newer_version_is_refused_by_both_numbers) {
  add(record_of("a", 1, 0.1));
  run("PRAGMA user_version = 2");
  EXPECT_EQ(error_of("history.db"), ": error: is a history of version 2; this program reads 1");
  EXPECT_NE(input_error_of([&] { add(record_of("b", 1, 0.1)); }), "no error");
}

// Every 64th byte in turn is overwritten: a damaged file is an error or gives numbers, and never ends the program.
TEST_F(HistoryFileTest, damaged_files_are_errors_or_finite_numbers) {
  for (int i = 0; i < 20; ++i) add(record_of("c" + std::to_string(i), i, 0.1 + i));
  const std::string whole = get("history.db");
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); at += 64) {
    std::string damaged = whole;
    for (std::size_t k = at; k < std::min(at + 8, damaged.size()); ++k)
      damaged[k] = static_cast<char>(0xff ^ damaged[k]);
    put("damaged.db", damaged);
    const std::string error = error_of("damaged.db");
    if (error != "no error") {
      ++refused;
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
  }
  EXPECT_GT(refused, 10);
  put("damaged.db", whole.substr(0, whole.size() / 2));
  EXPECT_NE(error_of("damaged.db").find("damaged"), std::string::npos) << error_of("damaged.db");
}

TEST_F(HistoryFileTest, addition_that_fails_leaves_the_file_as_it_was) {
  add(record_of("a", 1, 0.1));
  {
    SqliteDatabase database(path(), Access::write);
    SqliteTransaction transaction(database);
    database.run("DELETE FROM points");
  }
  EXPECT_EQ(load().series.at(0).points.size(), 1u);
  run("DROP TABLE shown");  // pictures are the last part of an addition
  EXPECT_NE(input_error_of([&] { add(record_of("b", 2, 0.2)); }).find("no such table: shown"), std::string::npos);
  EXPECT_EQ(load().records, 1u);
  EXPECT_EQ(load().series.at(0).points.size(), 1u);
}

TEST_F(HistoryFileTest, triggers_of_the_file_are_never_run) {
  add(record_of("a", 1, 0.1));
  run("CREATE TRIGGER t AFTER INSERT ON points BEGIN DELETE FROM points; END");
  add(record_of("b", 2, 0.2));
  EXPECT_EQ(load().series.at(0).points.size(), 2u);
}

// Each child adds ten records and is killed while it adds more; every record that was added is whole.
TEST_F(HistoryFileTest, two_processes_add_at_once_and_a_killed_one_loses_nothing) {
  std::vector<pid_t> children;
  for (const char* name : {"a", "b"}) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int i = 0; i < 10; ++i) add(record_of(name + std::to_string(i), i, 0.1));
      std::_Exit(0);
    }
    children.push_back(child);
  }
  const pid_t killed = fork();
  if (killed == 0) {
    for (int i = 0;; ++i) add(record_of("k" + std::to_string(i), i, 0.1));
  }
  usleep(200'000);
  kill(killed, SIGKILL);
  waitpid(killed, nullptr, 0);
  for (const pid_t child : children) {
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  const History history = load();
  ASSERT_EQ(history.series.size(), 1u);
  EXPECT_EQ(history.series[0].points.size(), history.records);
  EXPECT_GE(history.records, 20u);
}

TEST(HistoryDate, dates_of_git_and_records_are_seconds) {
  EXPECT_EQ(parse_date("--date", "1970-01-01"), 0);
  EXPECT_EQ(parse_date("--date", "2026-11-29T12:33:53Z"), 1795955633);
  EXPECT_EQ(parse_date("--date", "2026-11-29T13:33:53+01:00"), 1795955633);
  EXPECT_EQ(parse_date("--date", "2026-11-29 05:33:53-0700"), 1795955633);
  for (const char* wrong : {"", "yesterday", "2026-02-30", "1969-12-31", "2026-11-29T24:00:00Z", "2026-11-29T12:00"})
    EXPECT_NE(input_error_of([&] { parse_date("--date", wrong); }), "no error") << wrong;
  EXPECT_EQ(input_error_of([&] { parse_date("--date", "soon"); }),
            "--date: error: 'soon' is no date, expected such as 2026-11-29T12:33:53Z or 2026-11-29");
}

Results small_results() {
  Results results;
  results.suite = "table";
  results.host = {"Some CPU", "", "", 2, 0};
  results.scenes.push_back({"cornell", "scene.xml", "", 16, 16, 0, "cornell/path/spp=256/seed=9"});
  for (int seed = 1; seed <= 3; ++seed) {
    Result result;
    result.cell = {"cornell", "path", {"spp", 16}, static_cast<std::uint64_t>(seed)};
    result.wall_seconds = seed;
    result.cpu_seconds = 2.0 * seed;
    result.instructions = 1000u * static_cast<unsigned>(seed);
    result.calibration = {"1", 2, 0.01};
    result.metrics.push_back({"relmse", 0.1 * seed, ""});
    results.results.push_back(result);
  }
  Result reference = results.results[0];
  reference.cell.budget.amount = 256;
  reference.cell.seed = 9;
  results.results.push_back(reference);
  return results;
}

double value_of(const std::vector<HistoryValue>& values, Measure measure) {
  for (const HistoryValue& value : values)
    if (value.key.measure == measure) return value.value;
  return -1;
}

TEST(HistoryValues, are_medians_over_seeds_and_the_mean_error) {
  const std::vector<HistoryValue> values = values_of(small_results());
  EXPECT_EQ(values.size(), 4u);  // the reference is no value
  EXPECT_EQ(value_of(values, Measure::wall_seconds), 2);
  EXPECT_EQ(value_of(values, Measure::processor_seconds), 4);
  EXPECT_EQ(value_of(values, Measure::instructions), 2000);
  EXPECT_NEAR(value_of(values, Measure::relmse), 0.2, 1e-12);
  for (const HistoryValue& value : values) {
    EXPECT_EQ(value.key.size, "16x16");
    EXPECT_EQ(value.key.budget, "16 spp");
    EXPECT_EQ(value.key.machine.empty(), value.key.measure == Measure::relmse);
    EXPECT_EQ(value.calibration.has_value(), value.key.measure == Measure::processor_seconds);
  }
}

TEST(HistoryValues, instructions_that_one_seed_lacks_are_none) {
  Results results = small_results();
  results.results[1].instructions.reset();
  EXPECT_EQ(value_of(values_of(results), Measure::instructions), -1);
}

TEST(HistoryValues, times_of_two_machines_are_two_series_and_errors_one) {
  Results results = small_results(), other = small_results();
  other.host.cpu = "Other CPU";
  const auto key_of = [](const Results& from, Measure measure) {
    for (const HistoryValue& value : values_of(from))
      if (value.key.measure == measure) return value.key;
    return reports::SeriesKey{};
  };
  EXPECT_NE(key_of(results, Measure::processor_seconds), key_of(other, Measure::processor_seconds));
  EXPECT_EQ(key_of(results, Measure::relmse), key_of(other, Measure::relmse));
}

TEST(HistoryValues, failed_cells_and_sums_beyond_double_are_left_out) {
  Results results = small_results();
  for (Result& result : results.results) result.metrics[0].value = 1e308;
  results.results[0].status = Status::crash;
  const std::vector<HistoryValue> values = values_of(results);
  EXPECT_EQ(value_of(values, Measure::relmse), -1);
  EXPECT_EQ(value_of(values, Measure::wall_seconds), 2.5);
}

TEST(HistoryValues, gates_have_the_value_that_they_observed_and_their_verdict) {
  Results results = small_results();
  GateRecord gate;
  gate.name = "cornell/path/agreement";
  gate.scene = "cornell";
  gate.engine = "path";
  gate.metric = "agreement";
  gate.verdict = GateVerdict::fail;
  gate.observed = Estimate{0.03, {}};
  results.gates.push_back(gate);
  gate.name = "mine";
  results.gates.push_back(gate);
  gate.observed.reset();
  results.gates.push_back(gate);
  std::vector<HistoryValue> gates = values_of(results);
  EXPECT_EQ(gates.size(), 6u);  // four of cells, two of gates
  std::erase_if(gates, [](const HistoryValue& value) { return value.key.measure != Measure::gate; });
  ASSERT_EQ(gates.size(), 2u);
  EXPECT_EQ(gates[0].key.budget, "agreement");
  EXPECT_EQ(gates[1].key.budget, "agreement, mine");
  EXPECT_EQ(gates[0].verdict, "fail");
  EXPECT_EQ(gates[0].value, 0.03);
}

}  // namespace
}  // namespace photonproof::inline harness_history
