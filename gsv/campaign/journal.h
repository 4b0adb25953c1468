// The journal of an attempt: a file with the results of the runs that one process has executed. The
// process appends to it, while other processes read it, possibly on a shared file system.
//
// Format   lines of 16 hexadecimal digits (base::Hash of the rest), a space and a JSON object. The
//          first is {"attempt": …}. Then come {"begun": RUN} and {"result": …}, and {"end": true}
//          when the attempt has ended. These also have the key "at", a time in s since 1970. A line
//          with a wrong hash or without its newline is incomplete and is ignored.
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

// Returns the seconds since 1970. The machines of a queue share no other clock.
double UnixSeconds();

// Writes the journal of one attempt. Any thread may call it.
class JournalWriter {
 public:
  // Creates a file in the folder. Its name has the attempt's share (results.h), the machine, the id
  // of the process, and the time.
  static base::Result<std::unique_ptr<JournalWriter>> Create(const std::filesystem::path& folder,
                                                             const Attempt& attempt);
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  // Appends that the run has begun.
  base::Status Begin(std::int64_t run);
  // Appends a result, which is durable when this function returns.
  base::Status Add(const RunResult& result);
  // Appends that the attempt has ended.
  base::Status End();

 private:
  JournalWriter(std::filesystem::path file, int descriptor)
      : file_(std::move(file)), descriptor_(descriptor) {}
  // Appends an object as a line of the journal.
  base::Status Write(const nlohmann::ordered_json& json);

  const std::filesystem::path file_;
  const int descriptor_;
  base::Mutex mutex_;
};

// Reads the journal of an attempt that may still be running: each call of ReadNew() reads the lines
// that were appended since the last call. One thread at a time may use it.
class JournalReader {
 public:
  explicit JournalReader(std::filesystem::path file) : file_(std::move(file)) {}

  // Reads the new lines and returns the results in them.
  base::Result<std::vector<RunResult>> ReadNew();
  // The attempt according to the lines that were read; nullopt before the first line was read.
  const std::optional<Attempt>& attempt() const { return attempt_; }
  // Whether the attempt has ended, according to the lines that were read.
  bool is_over() const { return is_over_; }
  // The numbers of runs that have begun and have no result yet.
  const std::set<std::int64_t>& open_runs() const { return open_runs_; }
  // The number of lines that were ignored because their hash or content is wrong.
  std::size_t torn_lines() const { return torn_lines_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  // Applies one line. Appends its result, if it has one, to `results`.
  void Take(const nlohmann::ordered_json& json, std::vector<RunResult>& results);

  std::filesystem::path file_;
  std::uint64_t offset_ = 0;  // position in the file, in bytes
  std::optional<Attempt> attempt_;
  std::set<std::int64_t> open_runs_;
  std::size_t torn_lines_ = 0;
  bool is_over_ = false;
};

}  // namespace gsv::campaign
