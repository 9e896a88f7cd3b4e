#include "io/sqlite_database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include "core/error.h"
#include "core/text.h"

namespace arris::io {

std::string sqlite_version() {
  return sqlite3_libversion();
}

SqliteDatabase::SqliteDatabase(std::filesystem::path path) : path_(std::move(path)) {
  // "unix-none" takes no locks: the file is ours, and locks of its kind are not to be had on every file system.
  const int result =
      sqlite3_open_v2(path_.c_str(), &database_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, "unix-none");
  try {
    check(result, "cannot be opened");
    run("PRAGMA page_size=4096; PRAGMA encoding='UTF-8'; PRAGMA auto_vacuum=NONE; PRAGMA cache_size=-2000;"
        "PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; PRAGMA locking_mode=EXCLUSIVE; PRAGMA temp_store=MEMORY");
  } catch (...) {
    sqlite3_close(database_);
    throw;
  }
}

SqliteDatabase::~SqliteDatabase() {
  sqlite3_close(database_);
}

void SqliteDatabase::check(int result, std::string_view what) const {
  if (result == SQLITE_OK || result == SQLITE_ROW || result == SQLITE_DONE) return;
  const char* advice = (result & 0xff) == SQLITE_FULL ? "; free some space or choose another folder" : "";
  throw IoError(fmt::format("{}: {}: {}{}", printable(path_.string(), 1000), what,
                            database_ != nullptr ? sqlite3_errmsg(database_) : sqlite3_errstr(result), advice));
}

void SqliteDatabase::run(const char* statements) {
  check(sqlite3_exec(database_, statements, nullptr, nullptr, nullptr), "writing failed");
}

void SqliteDatabase::close() {
  check(sqlite3_close(database_), "closing failed");
  database_ = nullptr;
}

SqliteStatement::SqliteStatement(SqliteDatabase& database, const char* statement) : database_(database) {
  database_.check(sqlite3_prepare_v2(database_.database_, statement, -1, &statement_, nullptr), "writing failed");
}

SqliteStatement::~SqliteStatement() {
  sqlite3_finalize(statement_);
}

void SqliteStatement::bind(int parameter, std::int64_t value) {
  database_.check(sqlite3_bind_int64(statement_, parameter, value), "writing failed");
}

void SqliteStatement::bind(int parameter, double value) {
  database_.check(sqlite3_bind_double(statement_, parameter, value), "writing failed");
}

void SqliteStatement::bind(int parameter, std::string_view text) {
  database_.check(sqlite3_bind_text64(statement_, parameter, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8),
                  "writing failed");
}

void SqliteStatement::bind(int parameter, std::span<const std::byte> bytes) {
  database_.check(sqlite3_bind_blob64(statement_, parameter, bytes.data(), bytes.size(), SQLITE_TRANSIENT),
                  "writing failed");
}

void SqliteStatement::run() {
  database_.check(sqlite3_step(statement_), "writing failed");
  database_.check(sqlite3_reset(statement_), "writing failed");
  database_.check(sqlite3_clear_bindings(statement_), "writing failed");
}

}  // namespace arris::io
