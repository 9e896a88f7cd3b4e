#pragma once
/// @file The little of SQLite that is needed to write a file, with errors as exceptions.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace arris::io {

/// "3.40.1".
std::string sqlite_version();

/// A database file that nobody else uses; no journal: an unfinished file is of no use. Failing calls are IoErrors with
/// the path and the library's reason. Not thread-safe.
class SqliteDatabase {
 public:
  /// @param path  an empty file, or none.
  explicit SqliteDatabase(std::filesystem::path path);
  ~SqliteDatabase();
  SqliteDatabase(const SqliteDatabase&) = delete;
  SqliteDatabase& operator=(const SqliteDatabase&) = delete;

  /// One or more statements that return nothing.
  void run(const char* statements);
  /// Everything is in the file when this returns.
  void close();

 private:
  friend class SqliteStatement;
  void check(int result, std::string_view what) const;

  std::filesystem::path path_;
  sqlite3* database_ = nullptr;
};

/// A statement with parameters, run once for each set of values. The database must outlive it.
class SqliteStatement {
 public:
  SqliteStatement(SqliteDatabase& database, const char* statement);
  ~SqliteStatement();
  SqliteStatement(const SqliteStatement&) = delete;
  SqliteStatement& operator=(const SqliteStatement&) = delete;

  /// Parameters are numbered from 1; those that are not bound are NULL. Texts and bytes are copied.
  void bind(int parameter, std::int64_t value);
  void bind(int parameter, double value);
  void bind(int parameter, std::string_view text);
  void bind(int parameter, std::span<const std::byte> bytes);
  /// Runs it, and forgets the values.
  void run();

 private:
  SqliteDatabase& database_;
  sqlite3_stmt* statement_ = nullptr;
};

}  // namespace arris::io
