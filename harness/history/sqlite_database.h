// A file of SQLite and its statements, with errors as InputError about the file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace photonproof::inline harness_history {

class SqliteDatabase;

/// A prepared statement. Parameters and columns count from 1 and from 0, as SQLite's do.
class SqliteStatement {
 public:
  SqliteStatement(SqliteDatabase& database, const std::string& sql);
  void bind(int parameter, const std::string& text);
  void bind(int parameter, const char* text) { bind(parameter, std::string(text)); }
  void bind(int parameter, std::int64_t number);
  void bind(int parameter, double number);
  /// Absent is NULL.
  void bind(int parameter, const std::optional<double>& number);
  void bind_blob(int parameter, std::string_view bytes);
  /// Moves to the next row; false after the last one, which also makes the statement ready to run again. Throws
  /// InputError when the file is damaged, full, locked for too long or read-only.
  bool step();

  std::string text(int column) const;  ///< bytes of a text or a blob; empty of NULL
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::optional<double> maybe_real(int column) const;  ///< absent of NULL

 private:
  SqliteDatabase& database_;
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_;
};

class SqliteDatabase {
 public:
  enum class Access { read, write };
  /// With Access::write a missing file is made. The file is not trusted: its own schema may run no functions that
  /// reach outside. Waits up to `patience_seconds` for other processes. Throws InputError when it cannot be opened.
  SqliteDatabase(const std::string& file, Access access, double patience_seconds = 30);

  void run(const std::string& sql);
  std::int64_t number(const std::string& sql);  ///< first column of the only row
  std::int64_t last_row() const;
  /// The InputError for the library's last error.
  [[noreturn]] void fail();
  const std::string& file() const { return file_; }
  sqlite3* handle() const { return database_.get(); }

 private:
  std::string file_;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
};

/// Begins a transaction that writes; ends it unchanged unless `commit` was called.
class SqliteTransaction {
 public:
  explicit SqliteTransaction(SqliteDatabase& database);
  ~SqliteTransaction();
  SqliteTransaction(const SqliteTransaction&) = delete;
  SqliteTransaction& operator=(const SqliteTransaction&) = delete;
  void commit();

 private:
  SqliteDatabase* database_;
};

}  // namespace photonproof::inline harness_history
