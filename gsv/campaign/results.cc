#include "gsv/campaign/results.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include <fmt/format.h>

namespace gsv::campaign {
namespace {

constexpr std::chrono::milliseconds kLockPeriod{20};
constexpr const char* kBusyTimeout = "PRAGMA busy_timeout=2000";
constexpr const char* kSettings = "PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;";
constexpr const char* kTables =
    "CREATE TABLE IF NOT EXISTS campaign (key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;"
    "CREATE TABLE IF NOT EXISTS runs (run INTEGER PRIMARY KEY, parameters TEXT NOT NULL,"
    " status TEXT NOT NULL, message TEXT NOT NULL, state_hash TEXT NOT NULL,"
    " sim_time_s TEXT NOT NULL, wall_s TEXT NOT NULL, recording TEXT NOT NULL,"
    " metrics TEXT NOT NULL) STRICT;"
    "CREATE TABLE IF NOT EXISTS attempts (journal TEXT PRIMARY KEY, share TEXT NOT NULL,"
    " job TEXT NOT NULL, node TEXT NOT NULL, at_once INTEGER NOT NULL, submitted TEXT NOT NULL,"
    " started TEXT NOT NULL, ended TEXT NOT NULL, runs INTEGER NOT NULL, run_s TEXT NOT NULL)"
    " STRICT;";

std::string JsonText(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string Number(double number) { return fmt::format("{}", number); }

nlohmann::ordered_json ObjectIn(const std::string& text) {
  auto json = nlohmann::ordered_json::parse(text, nullptr, false);
  return json.is_object() ? json : nlohmann::ordered_json::object();
}

}  // namespace

Results::~Results() {
  if (lock_ >= 0) close(lock_);
}

base::Result<std::unique_ptr<Results>> Results::OpenToAdd(const std::string& file,
                                                          const Campaign& campaign,
                                                          std::chrono::milliseconds timeout) {
  // The kernel releases the lock when the process ends, also after a crash.
  const int lock = open((file + ".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  if (lock < 0) {
    return base::Fail(
        base::ErrorCode::kUnavailable,
        "cannot write files in its folder; choose a file in a folder that exists and is writable",
        file);
  }
  const auto give_up = std::chrono::steady_clock::now() + timeout;
  bool is_held = flock(lock, LOCK_EX | LOCK_NB) != 0;
  while (is_held && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(kLockPeriod);
    is_held = flock(lock, LOCK_EX | LOCK_NB) != 0;
  }
  if (is_held) {
    close(lock);
    return base::Fail(
        base::ErrorCode::kNotRunning,
        "another `gsv campaign run` is writing to it; wait until it ends, or choose another file",
        file);
  }
  auto database = broker::Database::Open(file);
  if (!database) {
    close(lock);
    return base::Fail(database.error());
  }
  std::unique_ptr<Results> results(new Results(*std::move(database), file));
  results->lock_ = lock;
  if (auto ok = results->Begin(campaign); !ok) return base::Fail(ok.error());
  return results;
}

base::Failure<base::Error> Results::Refused(const base::Error& error) const {
  std::string message = error.message;
  switch (database_.LastCode()) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      message += ": another program uses it; when that has ended, run the same command again";
      break;
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      message +=
          ": the file is damaged, or is not a results file. Move it away and repeat the command, "
          "which makes it again from the runs in the folder NAME.runs, if there is one";
      break;
    default:
      break;
  }
  return base::Fail(error.code, message, file_);
}

base::Status Results::Begin(const Campaign& campaign) {
  if (auto ok = database_.Run(kBusyTimeout); !ok) return Refused(ok.error());
  const auto foreign =
      database_.Ask("SELECT COUNT(*) > 0 AND SUM(name = 'campaign') = 0 FROM sqlite_schema");
  if (!foreign) return Refused(foreign.error());
  if (*foreign == "1") {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "is the database of another program; choose another file with --results",
                      file_);
  }
  if (auto ok = database_.Run(kSettings); !ok) return Refused(ok.error());
  if (auto ok = database_.Run(kTables); !ok) return Refused(ok.error());
  nlohmann::ordered_json paths = nlohmann::ordered_json::array();
  for (const Parameter& parameter : campaign.parameters) paths.push_back(parameter.path);
  auto insert = database_.Prepare("INSERT OR IGNORE INTO campaign VALUES (?, ?)");
  if (!insert) return Refused(insert.error());
  const std::pair<const char*, std::string> values[]{{"identity", campaign.Identity()},
                                                     {"runs", std::to_string(campaign.runs())},
                                                     {"parameters", paths.dump()},
                                                     {"scenario", campaign.scenario}};
  if (auto ok = database_.Run("BEGIN IMMEDIATE"); !ok) return Refused(ok.error());
  for (const auto& [key, value] : values) {
    if (auto ok = insert->Bind(1, std::string_view(key)).Bind(2, std::string_view(value)).Run();
        !ok)
      return Refused(ok.error());
  }
  if (auto ok = database_.Run("COMMIT"); !ok) return Refused(ok.error());
  const auto identity = database_.Ask("SELECT value FROM campaign WHERE key = 'identity'");
  if (!identity) return Refused(identity.error());
  if (*identity == campaign.Identity()) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "has the results of another campaign, or of this one before it was changed; "
                    "choose another file with --results",
                    file_);
}

base::Result<std::unique_ptr<Results>> Results::Open(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there are no results in this file; run the campaign first", file);
  }
  auto database = broker::Database::Open(file);
  if (!database) return base::Fail(database.error());
  std::unique_ptr<Results> results(new Results(*std::move(database), file));
  if (auto ok = results->database_.Run(kBusyTimeout); !ok) return base::Fail(ok.error());
  if (auto planned = results->PlannedRuns(); !planned) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      "is not a results file of a campaign: " + planned.error().message, file);
  }
  return results;
}

base::Status Results::Add(const std::vector<RunResult>& results,
                          const std::vector<Attempt>& attempts) {
  if (auto ok = database_.Run("BEGIN IMMEDIATE"); !ok) return Refused(ok.error());
  auto ok = Insert(results);
  if (ok) ok = Insert(attempts);
  if (ok) ok = database_.Run("COMMIT");
  if (ok) return {};
  const auto refused = Refused(ok.error());
  (void)database_.Run("ROLLBACK");
  return refused;
}

base::Status Results::Insert(const std::vector<RunResult>& results) {
  auto insert = database_.Prepare("INSERT OR IGNORE INTO runs VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  if (!insert) return base::Fail(insert.error());
  for (const RunResult& result : results) {
    const std::string texts[]{JsonText(result.parameters),
                              result.status,
                              result.message,
                              result.state_hash,
                              Number(result.sim_time),
                              Number(result.wall_time),
                              result.recording,
                              JsonText(result.metrics)};
    insert->Bind(1, result.run);
    for (int i = 0; i < 8; ++i) insert->Bind(i + 2, std::string_view(texts[i]));
    if (auto ok = insert->Run(); !ok) return ok;
  }
  return {};
}

base::Status Results::Insert(const std::vector<Attempt>& attempts) {
  auto insert =
      database_.Prepare("INSERT OR REPLACE INTO attempts VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  if (!insert) return base::Fail(insert.error());
  for (const Attempt& attempt : attempts) {
    const std::string times[]{Number(attempt.submitted), Number(attempt.started),
                              Number(attempt.ended), Number(attempt.run_seconds)};
    insert->Bind(1, std::string_view(attempt.journal)).Bind(2, std::string_view(attempt.share));
    insert->Bind(3, std::string_view(attempt.job)).Bind(4, std::string_view(attempt.node));
    insert->Bind(5, std::int64_t{attempt.at_once});
    for (int i = 0; i < 3; ++i) insert->Bind(i + 6, std::string_view(times[i]));
    insert->Bind(9, static_cast<std::int64_t>(attempt.runs)).Bind(10, std::string_view(times[3]));
    if (auto ok = insert->Run(); !ok) return ok;
  }
  return {};
}

base::Result<std::vector<Attempt>> Results::Attempts() {
  // Files of older versions, which had no shares, do not contain this table.
  const auto tables = database_.Ask("SELECT COUNT(*) FROM sqlite_schema WHERE name = 'attempts'");
  if (!tables) return Refused(tables.error());
  std::vector<Attempt> attempts;
  if (*tables == "0") return attempts;
  auto query = database_.Prepare(
      "SELECT journal, share, job, node, at_once, submitted, started, ended, runs, run_s "
      "FROM attempts ORDER BY CAST(started AS REAL), journal");
  if (!query) return Refused(query.error());
  for (;;) {
    const auto row = query->Next();
    if (!row) return Refused(row.error());
    if (!*row) return attempts;
    Attempt attempt{query->Bytes(0), query->Bytes(1), query->Bytes(2), query->Bytes(3),
                    static_cast<int>(query->Integer(4))};
    attempt.submitted = std::atof(query->Bytes(5).c_str());
    attempt.started = std::atof(query->Bytes(6).c_str());
    attempt.ended = std::atof(query->Bytes(7).c_str());
    attempt.runs = static_cast<std::size_t>(query->Integer(8));
    attempt.run_seconds = std::atof(query->Bytes(9).c_str());
    attempts.push_back(std::move(attempt));
  }
}

base::Result<std::set<std::int64_t>> Results::DoneRuns() {
  auto query = database_.Prepare("SELECT run FROM runs");
  if (!query) return Refused(query.error());
  std::set<std::int64_t> runs;
  for (;;) {
    const auto row = query->Next();
    if (!row) return Refused(row.error());
    if (!*row) return runs;
    runs.insert(query->Integer(0));
  }
}

base::Result<std::size_t> Results::NotPassed() {
  const auto count = database_.Ask("SELECT COUNT(*) FROM runs WHERE status != 'passed'");
  if (!count) return Refused(count.error());
  return static_cast<std::size_t>(std::atoll(count->c_str()));
}

base::Result<std::vector<RunResult>> Results::All() {
  auto query = database_.Prepare(
      "SELECT run, parameters, status, message, state_hash, sim_time_s, wall_s, recording, metrics "
      "FROM runs ORDER BY run");
  if (!query) return Refused(query.error());
  std::vector<RunResult> results;
  for (;;) {
    const auto row = query->Next();
    if (!row) return Refused(row.error());
    if (!*row) return results;
    RunResult result;
    result.run = query->Integer(0);
    result.parameters = ObjectIn(query->Bytes(1));
    result.status = query->Bytes(2);
    result.message = query->Bytes(3);
    result.state_hash = query->Bytes(4);
    result.sim_time = std::atof(query->Bytes(5).c_str());
    result.wall_time = std::atof(query->Bytes(6).c_str());
    result.recording = query->Bytes(7);
    result.metrics = ObjectIn(query->Bytes(8));
    results.push_back(std::move(result));
  }
}

base::Result<std::int64_t> Results::PlannedRuns() {
  const auto runs = database_.Ask("SELECT value FROM campaign WHERE key = 'runs'");
  if (!runs) return Refused(runs.error());
  return std::atoll(runs->c_str());
}

base::Result<std::vector<std::string>> Results::Parameters() {
  const auto text = database_.Ask("SELECT value FROM campaign WHERE key = 'parameters'");
  if (!text) return Refused(text.error());
  std::vector<std::string> paths;
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  for (const auto& path : json) {
    if (path.is_string()) paths.push_back(path.get<std::string>());
  }
  return paths;
}

}  // namespace gsv::campaign
