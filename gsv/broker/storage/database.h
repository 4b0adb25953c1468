// Owns an SQLite database and its prepared statements; the destructors close them.
//
// Errors   every failure has SQLite's message.
// Threads  one at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <sqlite3.h>

#include "gsv/base/error.h"

namespace gsv::broker {

// A prepared SQL statement.
class Statement {
 public:
  // Binds an argument. `place` counts from 1. A string_view is bound as text; BindBlob() binds
  // bytes.
  Statement& Bind(int place, std::int64_t value);
  Statement& Bind(int place, std::string_view text);
  Statement& BindBlob(int place, std::string_view bytes);

  // Runs a statement that returns no rows, and resets it for the next arguments.
  [[nodiscard]] base::Status Run();
  // Steps to the next row. Returns false after the last one.
  [[nodiscard]] base::Result<bool> Next();
  // These functions return a column of the present row, as an integer or as bytes. Columns count
  // from 0.
  std::int64_t Integer(int column) const;
  std::string Bytes(int column) const;

 private:
  friend class Database;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

// An open database.
class Database {
 public:
  // Opens the file of a database.
  [[nodiscard]] static base::Result<Database> Open(const std::string& path);

  // Prepares one statement.
  [[nodiscard]] base::Result<Statement> Prepare(std::string_view sql);
  // Runs one or more statements and ignores their rows.
  [[nodiscard]] base::Status Run(const std::string& sql);
  // Runs a query and returns the first column of the first row.
  [[nodiscard]] base::Result<std::string> Ask(std::string_view sql);

  // SQLite's last result code, such as SQLITE_BUSY or SQLITE_NOTADB.
  int LastCode() const;

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  };
  // Returns an error with SQLite's message about the last failure.
  base::Error Failure() const;

  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace gsv::broker
