#include "gsv/broker/storage/offer_file_schema.h"

#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

namespace gsv::broker {
namespace {

// "GSVB", which identifies a broker's file
constexpr int kApplication = 0x47535642;
// Version 1 had no links, proxies or attributes.
constexpr int kVersion = 2;

constexpr std::string_view kAddedInVersion2 =
    "CREATE TABLE IF NOT EXISTS link (name TEXT PRIMARY KEY, target TEXT NOT NULL,"
    "    def_pass_on INTEGER NOT NULL, limiting INTEGER NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE IF NOT EXISTS proxy (number INTEGER PRIMARY KEY, type TEXT NOT NULL,"
    "    target TEXT NOT NULL, properties BLOB NOT NULL, if_match_all INTEGER NOT NULL,"
    "    recipe TEXT NOT NULL, policies BLOB NOT NULL);"
    "CREATE TABLE IF NOT EXISTS attribute (name TEXT PRIMARY KEY, value BLOB NOT NULL)"
    "    WITHOUT ROWID;";

base::Error Unusable(Database& database, const std::string& path) {
  switch (database.LastCode()) {
    case SQLITE_BUSY:
      return {base::ErrorCode::kUnavailable,
              "another broker is using this file; stop it, or choose another file with --data",
              path};
    case SQLITE_NOTADB:
      return {base::ErrorCode::kCorrupt,
              "this is not the file of a broker; choose another with --data, or use --memory",
              path};
    case SQLITE_CORRUPT:
      return {base::ErrorCode::kCorrupt,
              "the file is damaged; restore a copy of it, or move it away to start without offers",
              path};
    default:
      return {base::ErrorCode::kUnavailable,
              fmt::format("cannot use the file ({}); choose another with --data, or use --memory",
                          sqlite3_errstr(database.LastCode())),
              path};
  }
}

base::Result<int> AskNumber(Database& database, const std::string& path, const char* pragma) {
  const auto answer = database.Ask(pragma);
  if (!answer) return base::Fail(Unusable(database, path));
  return std::atoi(answer->c_str());
}

base::Status Create(Database& database, const std::string& path, std::uint32_t stem) {
  const std::string sql = fmt::format(
      "BEGIN;"
      "CREATE TABLE broker (name TEXT PRIMARY KEY, value INTEGER NOT NULL) WITHOUT ROWID;"
      "CREATE TABLE offer (number INTEGER PRIMARY KEY, type TEXT NOT NULL,"
      "                    reference TEXT NOT NULL, properties BLOB NOT NULL);"
      "CREATE TABLE service_type (name TEXT PRIMARY KEY, description BLOB NOT NULL) WITHOUT ROWID;"
      "{}"
      "INSERT INTO broker VALUES ('{}', {}), ('{}', 1), ('{}', 1);"
      "PRAGMA application_id = {};"
      "PRAGMA user_version = {};"
      "COMMIT",
      kAddedInVersion2, kStem, stem, kNextNumber, kNextIncarnation, kApplication, kVersion);
  if (!database.Run(sql)) return base::Fail(Unusable(database, path));
  return {};
}

// Upgrades a file of an earlier version of gsv.
base::Status BringUpToDate(Database& database, const std::string& path) {
  const std::string sql =
      fmt::format("BEGIN; {} PRAGMA user_version = {}; COMMIT", kAddedInVersion2, kVersion);
  if (!database.Run(sql)) return base::Fail(Unusable(database, path));
  return {};
}

base::Status CheckIdentity(Database& database, const std::string& path) {
  const auto application = AskNumber(database, path, "PRAGMA application_id");
  if (!application) return base::Fail(application.error());
  if (*application != kApplication) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      "this is the database of another program; choose another file with --data",
                      path);
  }
  const auto version = AskNumber(database, path, "PRAGMA user_version");
  if (!version) return base::Fail(version.error());
  if (*version >= 1 && *version <= kVersion) return {};
  return base::Fail(base::ErrorCode::kCorrupt,
                    fmt::format("the file has format {}, but this gsv reads format {}; use the gsv "
                                "that wrote it, or choose another file with --data",
                                *version, kVersion),
                    path);
}

base::Status CheckSoundness(Database& database, const std::string& path) {
  const auto sound = database.Ask("PRAGMA quick_check(1)");
  if (!sound) return base::Fail(Unusable(database, path));
  if (*sound == "ok") return {};
  return base::Fail(base::ErrorCode::kCorrupt,
                    "the file is damaged (" + *sound +
                        "); restore a copy of it, or move it away to start without offers",
                    path);
}

}  // namespace

base::Result<Database> OpenOfferDatabase(const std::string& path, std::uint32_t stem) {
  auto database = Database::Open(path);
  if (!database) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "cannot open the file (" + database.error().message +
                          "); choose another with --data, or use --memory",
                      path);
  }
  // SQLite holds the lock from the first access on. The kernel releases it when the process ends.
  if (!database->Run("PRAGMA locking_mode = EXCLUSIVE")) {
    return base::Fail(Unusable(*database, path));
  }
  const auto pages = AskNumber(*database, path, "PRAGMA page_count");
  if (!pages) return base::Fail(pages.error());
  const bool is_new = *pages == 0;
  if (!is_new) {
    if (auto ok = CheckIdentity(*database, path); !ok) return base::Fail(ok.error());
  }
  if (!database->Run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;"
                     "BEGIN IMMEDIATE; COMMIT")) {
    return base::Fail(Unusable(*database, path));
  }
  if (is_new) {
    if (auto ok = Create(*database, path, stem); !ok) return base::Fail(ok.error());
  } else {
    if (auto ok = CheckSoundness(*database, path); !ok) return base::Fail(ok.error());
    if (auto ok = BringUpToDate(*database, path); !ok) return base::Fail(ok.error());
  }
  return std::move(*database);
}

}  // namespace gsv::broker
