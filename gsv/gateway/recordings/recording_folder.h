// A RecordingFolder lists the recordings that viewers may replay: the recordings in one folder, or
// a single file.
//
// A recording is a file NAME.mcap, a folder that rosbag2 opens, or a folder with run.mcap that
// `gsv test` has written for a failed test. Such folders may also be in the subfolder gsv-failures.
// Their names are then gsv-failures/NAME.
//
// Input    untrusted names and files. Other files are ignored. Symbolic links are ignored too,
//          unless a single recording is served.
// Threads  any. List() reads the index of each new file.
// Bounded  the newest thousand recordings.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/base/sim_time.h"

namespace gsv::gateway::recordings {

// One recording in the list of recordings. The data come from the index of the recording.
struct RecordingLine {
  enum class State {
    kComplete,
    kUnfinished,  // the recording is in progress or truncated, so its content is unknown
    kUnreadable,
  };

  std::string name;                                // name of the file or folder, as described above
  std::uint64_t size = 0;                          // bytes
  std::chrono::system_clock::time_point modified;  // when the file was last changed
  State state = State::kComplete;
  std::string problem;           // a sentence with the reason, if it is unreadable
  base::SimTime start{}, end{};  // simulated times of the first and the last message
  std::uint64_t messages = 0;    // number of messages
  // Empty or nullopt if the recording does not contain the value.
  std::string world;                    // name of the world
  std::optional<std::uint64_t> robots;  // number of robots
  std::string verdict;                  // "passed" or "failed"
  std::string sentence;                 // description of the first violation
  std::optional<double> violation_s;    // simulated time of the first violation
};

// Lists the recordings that viewers may replay.
class RecordingFolder {
 public:
  // The result of List().
  struct Listing {
    std::vector<RecordingLine> lines;  // the newest first
    std::size_t left_out = 0;          // number of older recordings that are not listed
  };

  // `only` is the name of the only recording that is served, a file with any extension or a folder.
  // Empty: all recordings of the folder.
  explicit RecordingFolder(std::filesystem::path folder, std::string only = {})
      : folder_(std::move(folder)), only_(std::move(only)) {}

  const std::filesystem::path& path() const { return folder_; }
  // The file name of the only recording that is served; empty: all recordings of the folder.
  const std::string& only() const { return only_; }

  // Lists the recordings. The list is empty if the folder does not exist.
  Listing List();

  // Returns the path for McapReader::Open(), or kNotFound with a sentence.
  base::Result<std::string> Find(const std::string& name) const;

 private:
  // Whether a recording in this folder may have this name.
  bool IsName(const std::string& name) const;
  // Returns the file of a recording by its name; empty if there is none.
  std::filesystem::path FileOf(const std::filesystem::path& path) const;
  // Returns the recording's line in the list.
  RecordingLine Describe(const std::string& name, const std::filesystem::path& file);

  const std::filesystem::path folder_;
  const std::string only_;  // name of the only recording that is served, or empty; see only()
  base::Mutex mutex_;
  std::map<std::string, RecordingLine> known_ GSV_GUARDED_BY(mutex_);  // by name
};

}  // namespace gsv::gateway::recordings
