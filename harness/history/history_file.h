// The file of a history: records of bench and gate by commit, in one database of SQLite. A record is added whole or not
// at all, also when the process is killed or two processes add at once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/history/history_values.h"
#include "harness/history/sqlite_database.h"
#include "reports/history/history_view.h"

namespace photonproof::inline harness_history {

/// Version of the file's tables. A file of a newer version is refused.
inline constexpr int history_version = 1;
/// Pictures are kept of the newest records, and a picture that several show once.
inline constexpr int records_with_pictures = 100;

/// The picture of a cell's first seed.
struct HistoryPicture {
  std::string scene, engine, budget;
  std::uint64_t seed = 0;
  std::string checksum;  ///< of the pixels
  std::string png;       ///< the file's bytes
};

struct HistoryRecord {
  std::string checksum;   ///< of results.json: a record is kept once
  std::string commit;     ///< its name: a hash, a tag, a version
  std::int64_t date = 0;  ///< of the commit, seconds since 1970
  std::string suite;
  std::vector<HistoryValue> values;
  std::vector<HistoryPicture> pictures;
};

class HistoryFile {
 public:
  /// Opens the file; with Access::write makes it if it is missing. Throws InputError when it is no history, has a newer
  /// version, or cannot be used.
  HistoryFile(const std::string& file, SqliteDatabase::Access access);

  /// Adds a record; false if it is there already. Throws InputError if it is there under another commit.
  bool add(const HistoryRecord& record);

  /// All series, without steps. A series has one point a commit: the median of its records there. A commit's date is
  /// the earliest of its records. Processor seconds with a calibration are multiplied by the median calibration over
  /// their own.
  reports::History load();

  /// Pictures of the commit's newest record that shows each scene, engine and budget.
  std::vector<HistoryPicture> pictures_of(const std::string& commit);

 private:
  void make_tables();
  void check_version();
  void add_values(std::int64_t record, const std::vector<HistoryValue>& values);
  void add_pictures(std::int64_t record, const std::vector<HistoryPicture>& pictures);
  SqliteDatabase database_;
};

}  // namespace photonproof::inline harness_history
