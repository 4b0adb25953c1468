#include "gsv/broker/storage/database.h"

#include <utility>

namespace gsv::broker {
namespace {

base::Error FailureOf(sqlite3* database) {
  return {base::ErrorCode::kUnavailable,
          database != nullptr ? sqlite3_errmsg(database) : "out of memory", ""};
}

}  // namespace

Statement& Statement::Bind(int place, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), place, value);
  return *this;
}

Statement& Statement::Bind(int place, std::string_view text) {
  sqlite3_bind_text(statement_.get(), place, text.data(), static_cast<int>(text.size()),
                    SQLITE_TRANSIENT);
  return *this;
}

Statement& Statement::BindBlob(int place, std::string_view bytes) {
  sqlite3_bind_blob(statement_.get(), place, bytes.data(), static_cast<int>(bytes.size()),
                    SQLITE_TRANSIENT);
  return *this;
}

base::Status Statement::Run() {
  const auto stepped = Next();
  sqlite3_reset(statement_.get());
  if (!stepped) return base::Fail(stepped.error());
  return {};
}

base::Result<bool> Statement::Next() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return base::Fail(FailureOf(sqlite3_db_handle(statement_.get())));
}

std::int64_t Statement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string Statement::Bytes(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
}

base::Result<Database> Database::Open(const std::string& path) {
  Database database;
  sqlite3* opened = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_FULLMUTEX;
  const int code = sqlite3_open_v2(path.c_str(), &opened, flags, nullptr);
  database.database_.reset(opened);
  if (code != SQLITE_OK) return base::Fail(database.Failure());
  return database;
}

base::Result<Statement> Database::Prepare(std::string_view sql) {
  Statement statement;
  sqlite3_stmt* prepared = nullptr;
  const int code = sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()),
                                      &prepared, nullptr);
  statement.statement_.reset(prepared);
  if (code != SQLITE_OK) return base::Fail(Failure());
  return statement;
}

base::Status Database::Run(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return {};
  return base::Fail(Failure());
}

base::Result<std::string> Database::Ask(std::string_view sql) {
  auto statement = Prepare(sql);
  if (!statement) return base::Fail(statement.error());
  const auto row = statement->Next();
  if (!row) return base::Fail(row.error());
  return *row ? statement->Bytes(0) : std::string();
}

int Database::LastCode() const { return sqlite3_errcode(database_.get()); }

base::Error Database::Failure() const { return FailureOf(database_.get()); }

}  // namespace gsv::broker
