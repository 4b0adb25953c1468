#include "gsv/campaign/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "gsv/base/hash.h"

namespace gsv::campaign {
namespace {

using Json = nlohmann::ordered_json;

std::string HashOf(std::string_view text) {
  base::Hash hash;
  hash.Add(text);
  return hash.Hex();
}

constexpr std::size_t kHashDigits = 16;

std::optional<Json> Parsed(std::string_view line) {
  if (line.size() <= kHashDigits + 1 || line[kHashDigits] != ' ') return std::nullopt;
  const std::string_view text = line.substr(kHashDigits + 1);
  if (HashOf(text) != line.substr(0, kHashDigits)) return std::nullopt;
  auto json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  return json;
}

Json ToJson(const RunResult& result) {
  return {{"run", result.run},
          {"status", result.status},
          {"message", result.message},
          {"state_hash", result.state_hash},
          {"sim_time_s", result.sim_time},
          {"wall_s", result.wall_time},
          {"recording", result.recording},
          {"parameters", result.parameters},
          {"metrics", result.metrics}};
}

RunResult ResultIn(const Json& json) {
  RunResult result;
  json.at("run").get_to(result.run);
  json.at("status").get_to(result.status);
  json.at("message").get_to(result.message);
  json.at("state_hash").get_to(result.state_hash);
  json.at("sim_time_s").get_to(result.sim_time);
  json.at("wall_s").get_to(result.wall_time);
  json.at("recording").get_to(result.recording);
  result.parameters = json.at("parameters");
  result.metrics = json.at("metrics");
  return result;
}

Json ToJson(const Attempt& attempt) {
  return {{"share", attempt.share},         {"job", attempt.job},
          {"node", attempt.node},           {"at_once", attempt.at_once},
          {"submitted", attempt.submitted}, {"started", attempt.started}};
}

Attempt AttemptIn(const Json& json) {
  Attempt attempt;
  json.at("share").get_to(attempt.share);
  json.at("job").get_to(attempt.job);
  json.at("node").get_to(attempt.node);
  json.at("at_once").get_to(attempt.at_once);
  json.at("submitted").get_to(attempt.submitted);
  json.at("started").get_to(attempt.started);
  attempt.ended = attempt.started;
  return attempt;
}

}  // namespace

double UnixSeconds() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

base::Result<std::unique_ptr<JournalWriter>> JournalWriter::Create(
    const std::filesystem::path& folder, const Attempt& attempt) {
  const auto file = folder / fmt::format("{}.{}.{}.{:.6f}.journal", attempt.share, attempt.node,
                                         getpid(), attempt.started);
  const int descriptor =
      open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      std::string("cannot write results: ") + std::strerror(errno), file);
  }
  std::unique_ptr<JournalWriter> journal(new JournalWriter(file, descriptor));
  if (auto ok = journal->Write({{"attempt", ToJson(attempt)}}); !ok) return base::Fail(ok.error());
  return journal;
}

JournalWriter::~JournalWriter() { close(descriptor_); }

base::Status JournalWriter::Begin(std::int64_t run) {
  return Write({{"begun", run}, {"at", UnixSeconds()}});
}

base::Status JournalWriter::Add(const RunResult& result) {
  return Write({{"result", ToJson(result)}, {"at", UnixSeconds()}});
}

base::Status JournalWriter::End() { return Write({{"end", true}, {"at", UnixSeconds()}}); }

base::Status JournalWriter::Write(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string line = HashOf(text) + " " + text + "\n";
  const base::MutexLock lock(mutex_);
  // One write() appends the whole line. If a full disk cuts the line off, the next append ends the
  // incomplete line.
  const ssize_t written = write(descriptor_, line.data(), line.size());
  std::string why;
  if (written != static_cast<ssize_t>(line.size())) {
    why = written < 0 ? std::strerror(errno) : "the disk is full";
    (void)!write(descriptor_, "\n", 1);
  } else if (fdatasync(descriptor_) != 0) {
    why = std::strerror(errno);
  }
  if (why.empty()) return {};
  return base::Fail(base::ErrorCode::kUnavailable, "cannot write results: " + why, file_);
}

base::Result<std::vector<RunResult>> JournalReader::ReadNew() {
  if (is_over_) return std::vector<RunResult>();
  std::ifstream stream(file_, std::ios::binary);
  if (!stream) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      std::string("cannot be read: ") + std::strerror(errno), file_);
  }
  stream.seekg(static_cast<std::streamoff>(offset_));
  std::ostringstream read;
  read << stream.rdbuf();
  const std::string text = read.str();
  std::vector<RunResult> results;
  std::size_t start = 0;
  for (std::size_t end; (end = text.find('\n', start)) != std::string::npos; start = end + 1) {
    const auto json = Parsed(std::string_view(text).substr(start, end - start));
    try {
      if (json) Take(*json, results);
      torn_lines_ += !json;
    } catch (const Json::exception&) {
      ++torn_lines_;
    }
  }
  offset_ += start;
  return results;
}

void JournalReader::Take(const Json& json, std::vector<RunResult>& results) {
  if (json.contains("attempt")) {
    attempt_ = AttemptIn(json["attempt"]);
    attempt_->journal = file_.filename();
    return;
  }
  if (!attempt_) return;
  attempt_->ended = std::max(attempt_->ended, json.at("at").get<double>());
  if (json.contains("end")) {
    is_over_ = true;
  } else if (json.contains("begun")) {
    open_runs_.insert(json["begun"].get<std::int64_t>());
  } else {
    RunResult result = ResultIn(json.at("result"));
    open_runs_.erase(result.run);
    ++attempt_->runs;
    attempt_->run_seconds += result.wall_time;
    results.push_back(std::move(result));
  }
}

}  // namespace gsv::campaign
