#include "harness/history/history_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "harness/statistics/statistics.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_history {
namespace {

using reports::History;
using reports::HistoryPoint;
using reports::HistorySeries;
using reports::Measure;

constexpr std::int64_t application = 0x70706873;  // "pphs": tells a history from other databases

constexpr const char* tables = R"(
CREATE TABLE records(id INTEGER PRIMARY KEY, checksum TEXT NOT NULL UNIQUE, commit_name TEXT NOT NULL,
  date INTEGER NOT NULL, suite TEXT NOT NULL) STRICT;
CREATE TABLE series(id INTEGER PRIMARY KEY, suite TEXT NOT NULL, scene TEXT NOT NULL, size TEXT NOT NULL,
  engine TEXT NOT NULL, budget TEXT NOT NULL, measure TEXT NOT NULL, machine TEXT NOT NULL,
  UNIQUE(suite, scene, size, engine, budget, measure, machine)) STRICT;
CREATE TABLE points(series INTEGER NOT NULL REFERENCES series(id), record INTEGER NOT NULL REFERENCES records(id),
  value REAL NOT NULL, low REAL, high REAL, calibration REAL, seeds INTEGER NOT NULL, verdict TEXT NOT NULL,
  PRIMARY KEY(series, record)) STRICT, WITHOUT ROWID;
CREATE TABLE pictures(checksum TEXT PRIMARY KEY, png BLOB NOT NULL) STRICT, WITHOUT ROWID;
CREATE TABLE shown(record INTEGER NOT NULL REFERENCES records(id), scene TEXT NOT NULL, engine TEXT NOT NULL,
  budget TEXT NOT NULL, seed TEXT NOT NULL, picture TEXT NOT NULL REFERENCES pictures(checksum),
  PRIMARY KEY(record, scene, engine, budget)) STRICT, WITHOUT ROWID;
)";

constexpr const char* series_insertion = R"(
INSERT OR IGNORE INTO series(suite, scene, size, engine, budget, measure, machine) VALUES(?, ?, ?, ?, ?, ?, ?)
)";
// The first seven parameters are those of the series.
constexpr const char* point_insertion = R"(
INSERT OR REPLACE INTO points(series, record, value, low, high, calibration, seeds, verdict)
  SELECT id, ?8, ?9, ?10, ?11, ?12, ?13, ?14 FROM series WHERE suite = ?1 AND scene = ?2 AND size = ?3
    AND engine = ?4 AND budget = ?5 AND measure = ?6 AND machine = ?7
)";
constexpr const char* picture_query = R"(
SELECT scene, engine, budget, seed, picture, png FROM shown JOIN pictures ON picture = pictures.checksum
  JOIN records ON record = id WHERE commit_name = ? ORDER BY record DESC
)";

/// One row of `points`, before the records of a commit are merged.
struct StoredPoint {
  std::size_t commit = 0;
  double value = 0;
  std::optional<Interval> interval;
  std::optional<double> calibration;
  int seeds = 0;
  std::string verdict;
};

std::optional<GateVerdict> verdict_of(const std::string& word) {
  for (const GateVerdict verdict : {GateVerdict::pass, GateVerdict::fail, GateVerdict::inconclusive})
    if (to_string(verdict) == word) return verdict;
  return std::nullopt;
}

/// The median value of a commit's records, the widest of their intervals relative to their values, and the last
/// verdict. Precondition: at least one.
HistoryPoint merged(const std::vector<StoredPoint>& records) {
  HistoryPoint point;
  std::vector<double> values;
  for (const StoredPoint& record : records) {
    values.push_back(record.value);
    point.seeds = std::max(point.seeds, record.seeds);
    point.verdict = verdict_of(record.verdict);
  }
  point.commit = records.front().commit;
  point.value = median_of(values);
  double below = 0, above = 0;
  for (const StoredPoint& record : records)
    if (record.interval) {
      below = std::max(below, record.value - record.interval->low);
      above = std::max(above, record.interval->high - record.value);
    }
  if (below > 0 || above > 0) point.interval = Interval{point.value - below, point.value + above};
  return point;
}

/// Multiplies each time by the median calibration over its own. False if a point has none.
bool calibrate(std::vector<StoredPoint>& points) {
  std::vector<double> calibrations;
  for (const StoredPoint& point : points) {
    if (!point.calibration || !(*point.calibration > 0)) return false;
    calibrations.push_back(*point.calibration);
  }
  const double usual = median_of(calibrations);
  for (StoredPoint& point : points) {
    const double factor = usual / *point.calibration;
    point.value *= factor;
    if (point.interval) point.interval = Interval{point.interval->low * factor, point.interval->high * factor};
  }
  return true;
}

/// Returns the number of values that calibration moved beyond the range of double; they are left out.
std::size_t set_points(std::vector<StoredPoint> stored, HistorySeries& series) {
  series.is_calibrated = series.key.measure == Measure::processor_seconds && calibrate(stored);
  const std::size_t left_out = std::erase_if(stored, [](const StoredPoint& p) { return !std::isfinite(p.value); });
  std::ranges::stable_sort(stored, {}, &StoredPoint::commit);
  for (std::size_t first = 0, end = 0; first < stored.size(); first = end) {
    while (end < stored.size() && stored[end].commit == stored[first].commit) ++end;
    series.points.push_back(merged(
        {stored.begin() + static_cast<std::ptrdiff_t>(first), stored.begin() + static_cast<std::ptrdiff_t>(end)}));
  }
  return left_out;
}

/// Wall time is only shown where the same cells have processor time.
void choose_judged(std::vector<HistorySeries>& all) {
  std::set<std::tuple<std::string, std::string, std::string, std::string, std::string>> timed;
  const auto cell_of = [](const reports::SeriesKey& key) {
    return std::make_tuple(key.suite, key.scene, key.size, key.engine, key.budget);
  };
  for (const HistorySeries& series : all)
    if (series.key.measure == Measure::processor_seconds) timed.insert(cell_of(series.key));
  for (HistorySeries& series : all)
    series.is_judged = series.key.measure != Measure::wall_seconds || !timed.contains(cell_of(series.key));
}

}  // namespace

HistoryFile::HistoryFile(const std::string& file, SqliteDatabase::Access access) : database_(file, access) {
  if (access == SqliteDatabase::Access::write) {
    SqliteTransaction transaction(database_);
    if (database_.number("SELECT count(*) FROM sqlite_schema") == 0) make_tables();
    transaction.commit();
  }
  check_version();
}

void HistoryFile::make_tables() {
  database_.run(tables);
  database_.run("PRAGMA application_id = " + std::to_string(application) +
                "; PRAGMA user_version = " + std::to_string(history_version));
}

void HistoryFile::check_version() {
  if (database_.number("PRAGMA application_id") != application)
    throw InputError(database_.file(), "is no history of photonproof");
  const std::int64_t version = database_.number("PRAGMA user_version");
  if (version != history_version)
    throw InputError(database_.file(), "is a history of version " + std::to_string(version) + "; this program reads " +
                                           std::to_string(history_version));
}

bool HistoryFile::add(const HistoryRecord& record) {
  SqliteTransaction transaction(database_);
  SqliteStatement there(database_, "SELECT commit_name FROM records WHERE checksum = ?");
  there.bind(1, record.checksum);
  if (there.step()) {
    if (there.text(0) != record.commit)
      throw InputError(database_.file(),
                       "has this record already, as commit " + there.text(0) + ", not " + record.commit);
    return false;
  }
  SqliteStatement insert(database_, "INSERT INTO records(checksum, commit_name, date, suite) VALUES(?, ?, ?, ?)");
  insert.bind(1, record.checksum);
  insert.bind(2, record.commit);
  insert.bind(3, record.date);
  insert.bind(4, record.suite);
  insert.step();
  const std::int64_t id = database_.last_row();
  add_values(id, record.values);
  add_pictures(id, record.pictures);
  transaction.commit();
  return true;
}

void HistoryFile::add_values(std::int64_t record, const std::vector<HistoryValue>& values) {
  SqliteStatement insert_series(database_, series_insertion), insert_point(database_, point_insertion);
  for (const HistoryValue& value : values) {
    for (SqliteStatement* statement : {&insert_series, &insert_point}) {
      int parameter = 0;
      for (const std::string* text :
           {&value.key.suite, &value.key.scene, &value.key.size, &value.key.engine, &value.key.budget})
        statement->bind(++parameter, *text);
      statement->bind(++parameter, to_string(value.key.measure));
      statement->bind(++parameter, value.key.machine);
    }
    insert_series.step();
    insert_point.bind(8, record);
    insert_point.bind(9, value.value);
    insert_point.bind(10, value.interval ? std::optional(value.interval->low) : std::nullopt);
    insert_point.bind(11, value.interval ? std::optional(value.interval->high) : std::nullopt);
    insert_point.bind(12, value.calibration);
    insert_point.bind(13, std::int64_t{value.seeds});
    insert_point.bind(14, value.verdict);
    insert_point.step();
  }
}

void HistoryFile::add_pictures(std::int64_t record, const std::vector<HistoryPicture>& pictures) {
  SqliteStatement insert(database_, "INSERT OR IGNORE INTO pictures(checksum, png) VALUES(?, ?)");
  SqliteStatement show(
      database_, "INSERT OR IGNORE INTO shown(record, scene, engine, budget, seed, picture) VALUES(?, ?, ?, ?, ?, ?)");
  for (const HistoryPicture& picture : pictures) {
    insert.bind(1, picture.checksum);
    insert.bind_blob(2, picture.png);
    insert.step();
    show.bind(1, record);
    show.bind(2, picture.scene);
    show.bind(3, picture.engine);
    show.bind(4, picture.budget);
    show.bind(5, std::to_string(picture.seed));
    show.bind(6, picture.checksum);
    show.step();
  }
  database_.run("DELETE FROM shown WHERE record NOT IN (SELECT id FROM records ORDER BY date DESC, id DESC LIMIT " +
                std::to_string(records_with_pictures) + ")");
  database_.run("DELETE FROM pictures WHERE checksum NOT IN (SELECT picture FROM shown)");
}

reports::History HistoryFile::load() {
  History history;
  SqliteDatabase& database = database_;
  database.run("BEGIN");  // one state of the file, even while another process adds
  std::map<std::string, std::size_t> commit_index;
  SqliteStatement commits(database, "SELECT commit_name, min(date) FROM records GROUP BY commit_name ORDER BY 2, 1");
  while (commits.step()) {
    commit_index[commits.text(0)] = history.commits.size();
    history.commits.push_back({commits.text(0), commits.integer(1)});
  }
  std::map<std::int64_t, std::size_t> commit_of_record;
  SqliteStatement records(database, "SELECT id, commit_name FROM records");
  while (records.step()) commit_of_record[records.integer(0)] = commit_index[records.text(1)];
  history.records = commit_of_record.size();
  SqliteStatement all(database, "SELECT id, suite, scene, size, engine, budget, measure, machine FROM series");
  SqliteStatement points(
      database, "SELECT record, value, low, high, calibration, seeds, verdict FROM points WHERE series = ? ORDER BY 1");
  while (all.step()) {
    const std::optional<Measure> measure = reports::measure_named(all.text(6));
    if (!measure) throw InputError(database.file(), "is damaged: it has a measure '" + all.text(6) + "'");
    HistorySeries series;
    series.key = {all.text(1), all.text(2), all.text(3), all.text(4), all.text(5), *measure, all.text(7)};
    std::vector<StoredPoint> stored;
    points.bind(1, all.integer(0));
    while (points.step()) {
      StoredPoint point{commit_of_record[points.integer(0)], points.real(1), {}, points.maybe_real(4),
                        static_cast<int>(points.integer(5)), points.text(6)};
      const std::optional<double> low = points.maybe_real(2), high = points.maybe_real(3);
      if (low && high && std::isfinite(*low) && std::isfinite(*high)) point.interval = Interval{*low, *high};
      stored.push_back(std::move(point));
    }
    history.left_out += set_points(std::move(stored), series);
    if (!series.points.empty()) history.series.push_back(std::move(series));
  }
  database.run("COMMIT");
  std::ranges::sort(history.series, {}, &HistorySeries::key);
  choose_judged(history.series);
  return history;
}

std::vector<HistoryPicture> HistoryFile::pictures_of(const std::string& commit) {
  SqliteStatement find(database_, picture_query);
  find.bind(1, commit);
  std::vector<HistoryPicture> pictures;
  std::set<std::tuple<std::string, std::string, std::string>> seen;
  while (find.step()) {
    HistoryPicture picture{find.text(0), find.text(1), find.text(2), 0, find.text(4), find.text(5)};
    picture.seed = std::strtoull(find.text(3).c_str(), nullptr, 10);
    if (seen.insert({picture.scene, picture.engine, picture.budget}).second) pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace photonproof::inline harness_history
