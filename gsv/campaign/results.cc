#include "gsv/campaign/results.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>

#include <fmt/format.h>

#include "gsv/base/hash.h"

namespace gsv::campaign {
namespace {

constexpr const char* kTables =
    "CREATE TABLE IF NOT EXISTS campaign (key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;"
    "CREATE TABLE IF NOT EXISTS runs (run INTEGER PRIMARY KEY, parameters TEXT NOT NULL,"
    " status TEXT NOT NULL, message TEXT NOT NULL, state_hash TEXT NOT NULL,"
    " sim_time_s TEXT NOT NULL, wall_s TEXT NOT NULL, recording TEXT NOT NULL,"
    " metrics TEXT NOT NULL) STRICT;";

std::string IdentityOf(const Campaign& campaign) {
  base::Hash hash;
  hash.Add(std::string_view(campaign.Definition()));
  return hash.Hex();
}

std::string JsonText(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::ordered_json ObjectIn(const std::string& text) {
  auto json = nlohmann::ordered_json::parse(text, nullptr, false);
  return json.is_object() ? json : nlohmann::ordered_json::object();
}

}  // namespace

Results::~Results() {
  if (lock_ >= 0) close(lock_);
}

base::Result<std::unique_ptr<Results>> Results::OpenToAdd(const std::string& file,
                                                          const Campaign& campaign) {
  // The kernel gives it back when the process ends, however that does.
  const int lock = open((file + ".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  if (lock < 0) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "cannot be written beside; name a file in a folder that is there", file);
  }
  if (flock(lock, LOCK_EX | LOCK_NB) != 0) {
    close(lock);
    return base::Fail(base::ErrorCode::kUnavailable,
                      "another `gsv campaign run` adds to it; wait for that, or name another file",
                      file);
  }
  auto database = broker::Database::Open(file);
  if (!database) {
    close(lock);
    return base::Fail(database.error());
  }
  std::unique_ptr<Results> results(new Results(*std::move(database)));
  results->lock_ = lock;
  if (auto ok = results->Begin(campaign, file); !ok) return base::Fail(ok.error());
  return results;
}

base::Status Results::Begin(const Campaign& campaign, const std::string& file) {
  if (auto ok = database_.Run("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;"); !ok)
    return ok;
  if (auto ok = database_.Run(kTables); !ok) return ok;
  nlohmann::ordered_json paths = nlohmann::ordered_json::array();
  for (const Parameter& parameter : campaign.parameters) paths.push_back(parameter.path);
  auto insert = database_.Prepare("INSERT OR IGNORE INTO campaign VALUES (?, ?)");
  if (!insert) return base::Fail(insert.error());
  const std::pair<const char*, std::string> values[]{{"identity", IdentityOf(campaign)},
                                                     {"runs", std::to_string(campaign.runs())},
                                                     {"parameters", paths.dump()},
                                                     {"scenario", campaign.scenario}};
  if (auto ok = database_.Run("BEGIN IMMEDIATE"); !ok) return ok;
  for (const auto& [key, value] : values) {
    if (auto ok = insert->Bind(1, std::string_view(key)).Bind(2, std::string_view(value)).Run();
        !ok)
      return ok;
  }
  if (auto ok = database_.Run("COMMIT"); !ok) return ok;
  const auto identity = database_.Ask("SELECT value FROM campaign WHERE key = 'identity'");
  if (!identity) return base::Fail(identity.error());
  if (*identity == IdentityOf(campaign)) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "holds the results of another campaign, or of this one before it was changed; "
                    "name another file by --results",
                    file);
}

base::Result<std::unique_ptr<Results>> Results::Open(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return base::Fail(base::ErrorCode::kNotFound, "there are no results of that name", file);
  }
  auto database = broker::Database::Open(file);
  if (!database) return base::Fail(database.error());
  std::unique_ptr<Results> results(new Results(*std::move(database)));
  if (auto planned = results->PlannedRuns(); !planned) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      "holds no campaign's results: " + planned.error().Sentence(), file);
  }
  return results;
}

base::Status Results::Add(const std::vector<RunResult>& results) {
  if (auto ok = database_.Run("BEGIN IMMEDIATE"); !ok) return ok;
  auto insert = database_.Prepare("INSERT OR IGNORE INTO runs VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  if (!insert) return base::Fail(insert.error());
  for (const RunResult& result : results) {
    const std::string texts[]{JsonText(result.parameters),
                              result.status,
                              result.message,
                              result.state_hash,
                              fmt::format("{}", result.sim_time),
                              fmt::format("{}", result.wall_time),
                              result.recording,
                              JsonText(result.metrics)};
    insert->Bind(1, result.run);
    for (int i = 0; i < 8; ++i) insert->Bind(i + 2, std::string_view(texts[i]));
    if (auto ok = insert->Run(); !ok) {
      (void)database_.Run("ROLLBACK");
      return ok;
    }
  }
  return database_.Run("COMMIT");
}

base::Result<std::set<std::int64_t>> Results::DoneRuns() {
  auto query = database_.Prepare("SELECT run FROM runs");
  if (!query) return base::Fail(query.error());
  std::set<std::int64_t> runs;
  for (;;) {
    const auto row = query->Next();
    if (!row) return base::Fail(row.error());
    if (!*row) return runs;
    runs.insert(query->Integer(0));
  }
}

base::Result<std::vector<RunResult>> Results::All() {
  auto query = database_.Prepare(
      "SELECT run, parameters, status, message, state_hash, sim_time_s, wall_s, recording, metrics "
      "FROM runs ORDER BY run");
  if (!query) return base::Fail(query.error());
  std::vector<RunResult> results;
  for (;;) {
    const auto row = query->Next();
    if (!row) return base::Fail(row.error());
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
  if (!runs) return base::Fail(runs.error());
  return std::atoll(runs->c_str());
}

base::Result<std::vector<std::string>> Results::Parameters() {
  const auto text = database_.Ask("SELECT value FROM campaign WHERE key = 'parameters'");
  if (!text) return base::Fail(text.error());
  std::vector<std::string> paths;
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  for (const auto& path : json) {
    if (path.is_string()) paths.push_back(path.get<std::string>());
  }
  return paths;
}

}  // namespace gsv::campaign
