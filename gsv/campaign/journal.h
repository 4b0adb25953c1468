// What an attempt at a share of a campaign's runs has come to: a file that one process adds to
// while others read it, on a file system that they may share.
//
// Format   lines of 16 hexadecimal digits (base::Hash of the rest), a blank and a JSON object:
//          first {"attempt": …}, then {"begun": RUN} and {"result": …}, and
//          {"end": true} where the attempt came to its end. A line that its hash does
//          not fit, or that has no end yet, was torn and counts for nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/campaign/results.h"

namespace gsv::campaign {

// Wall time in seconds since 1970: machines that share a queue have no other clock in common.
double UnixSeconds();

// Threads  any.
class JournalWriter {
 public:
  // A new file in the folder, named after the attempt's share, the machine and the process.
  static base::Result<std::unique_ptr<JournalWriter>> Create(const std::filesystem::path& folder,
                                                             const Attempt& attempt);
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  base::Status Begin(std::int64_t run);
  // It is on the disk when this returns.
  base::Status Add(const RunResult& result);
  base::Status End();

 private:
  JournalWriter(std::filesystem::path file, int descriptor)
      : file_(std::move(file)), descriptor_(descriptor) {}
  base::Status Write(const nlohmann::ordered_json& json);

  const std::filesystem::path file_;
  const int descriptor_;
  base::Mutex mutex_;
};

// Threads  one at a time.
class JournalReader {
 public:
  explicit JournalReader(std::filesystem::path file) : file_(std::move(file)) {}

  // The results that have come since the last time.
  base::Result<std::vector<RunResult>> ReadNew();
  // As far as it was read; nothing before its first line.
  const std::optional<Attempt>& attempt() const { return attempt_; }
  bool is_over() const { return is_over_; }
  // Runs that were begun and of which nothing has come.
  const std::set<std::int64_t>& open_runs() const { return open_runs_; }
  std::size_t torn_lines() const { return torn_lines_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  void Take(const nlohmann::ordered_json& json, std::vector<RunResult>& results);

  std::filesystem::path file_;
  std::uint64_t offset_ = 0;  // bytes
  std::optional<Attempt> attempt_;
  std::set<std::int64_t> open_runs_;
  std::size_t torn_lines_ = 0;
  bool is_over_ = false;
};

}  // namespace gsv::campaign
