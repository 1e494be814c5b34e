#include "harness/history/sqlite_database.h"

#include <sqlite3.h>

#include <exception>

#include "scenes/base/input_error.h"

namespace photonproof::inline harness_history {
namespace {

std::string sentence_of(int code, const char* words) {
  switch (code & 0xff) {
    case SQLITE_NOTADB:
      return "is no history of photonproof";
    case SQLITE_CORRUPT:
      return "is damaged: " + std::string(words);
    case SQLITE_FULL:
      return "cannot be written: the disk is full";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "is being written by another process";
    case SQLITE_READONLY:
      return "cannot be written: it or its folder is read-only";
    case SQLITE_CANTOPEN:
      return "cannot be opened: " + std::string(words);
    default:
      return "cannot be used: " + std::string(words);
  }
}

}  // namespace

SqliteStatement::SqliteStatement(SqliteDatabase& database, const std::string& sql)
    : database_(database), statement_(nullptr, sqlite3_finalize) {
  sqlite3_stmt* made = nullptr;
  if (sqlite3_prepare_v2(database.handle(), sql.c_str(), static_cast<int>(sql.size()), &made, nullptr) != SQLITE_OK)
    database.fail();
  statement_.reset(made);
}

void SqliteStatement::bind(int parameter, const std::string& text) {
  if (sqlite3_bind_text64(statement_.get(), parameter, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8) !=
      SQLITE_OK)
    database_.fail();
}

void SqliteStatement::bind(int parameter, std::int64_t number) {
  if (sqlite3_bind_int64(statement_.get(), parameter, number) != SQLITE_OK) database_.fail();
}

void SqliteStatement::bind(int parameter, double number) {
  if (sqlite3_bind_double(statement_.get(), parameter, number) != SQLITE_OK) database_.fail();
}

void SqliteStatement::bind(int parameter, const std::optional<double>& number) {
  if (number) return bind(parameter, *number);
  if (sqlite3_bind_null(statement_.get(), parameter) != SQLITE_OK) database_.fail();
}

void SqliteStatement::bind_blob(int parameter, std::string_view bytes) {
  if (sqlite3_bind_blob64(statement_.get(), parameter, bytes.data(), bytes.size(), SQLITE_TRANSIENT) != SQLITE_OK)
    database_.fail();
}

bool SqliteStatement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_.fail();
  sqlite3_reset(statement_.get());
  return false;
}

std::string SqliteStatement::text(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const int count = sqlite3_column_bytes(statement_.get(), column);
  return bytes == nullptr ? "" : std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
}

std::int64_t SqliteStatement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

double SqliteStatement::real(int column) const { return sqlite3_column_double(statement_.get(), column); }

std::optional<double> SqliteStatement::maybe_real(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
  return real(column);
}

SqliteDatabase::SqliteDatabase(const std::string& file, Access access, double patience_seconds)
    : file_(file), database_(nullptr, sqlite3_close) {
  // A reader may have to undo what a killed writer left, so it opens for writing too; SQLite falls back to reading.
  const int flags = SQLITE_OPEN_READWRITE | (access == Access::write ? SQLITE_OPEN_CREATE : 0);
  sqlite3* made = nullptr;
  // A relative name may begin with "file:" or be ":memory:"; "./" makes it a file's.
  const int code = sqlite3_open_v2((file.starts_with('/') ? file : "./" + file).c_str(), &made, flags, nullptr);
  database_.reset(made);
  if (made == nullptr) throw InputError(file, "cannot be opened: out of memory");
  if (code != SQLITE_OK) fail();
  sqlite3_busy_timeout(made, static_cast<int>(1000 * patience_seconds));
  sqlite3_db_config(made, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(made, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(made, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(made, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  run("PRAGMA cell_size_check = ON; PRAGMA foreign_keys = ON");
}

void SqliteDatabase::run(const std::string& sql) {
  if (sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::int64_t SqliteDatabase::number(const std::string& sql) {
  SqliteStatement statement(*this, sql);
  return statement.step() ? statement.integer(0) : 0;
}

std::int64_t SqliteDatabase::last_row() const { return sqlite3_last_insert_rowid(handle()); }

void SqliteDatabase::fail() {
  throw InputError(file_, sentence_of(sqlite3_errcode(handle()), sqlite3_errmsg(handle())));
}

SqliteTransaction::SqliteTransaction(SqliteDatabase& database) : database_(&database) {
  database.run("BEGIN IMMEDIATE");
}

SqliteTransaction::~SqliteTransaction() {
  if (database_ == nullptr) return;
  try {
    database_->run("ROLLBACK");
  } catch (const std::exception&) {  // The library rolled back itself, or will when the file is opened next.
  }
}

void SqliteTransaction::commit() {
  database_->run("COMMIT");
  database_ = nullptr;
}

}  // namespace photonproof::inline harness_history
