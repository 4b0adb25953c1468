// The recordings that people may replay: those that lie in one folder, or a single one.
//
// Input    hostile: names come from browsers, files from anywhere. Only what lies directly in the
//          folder is seen, and no link that leads elsewhere.
// Threads  any. List() reads the index at the end of each file that it has not seen yet.
// Bounded  the newest thousand are listed.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/base/sim_time.h"

namespace gsv::gateway::recordings {

struct RecordingLine {
  enum class State {
    kComplete,
    kUnfinished,  // being recorded, or cut off: nothing is known of what it holds
    kUnreadable,
  };

  std::string name;        // of the file, or of the folder that rosbag2 opens
  std::uint64_t size = 0;  // bytes
  std::chrono::system_clock::time_point modified;
  State state = State::kComplete;
  std::string problem;  // a sentence, if it is unreadable
  base::SimTime start{}, end{};
  std::uint64_t messages = 0;
};

class RecordingFolder {
 public:
  struct Listing {
    std::vector<RecordingLine> lines;  // the newest first
    std::size_t left_out = 0;
  };

  // `only`: the one recording that is seen of what is in the folder, whatever its name ends in;
  // empty: all are.
  explicit RecordingFolder(std::filesystem::path folder, std::string only = {})
      : folder_(std::move(folder)), only_(std::move(only)) {}

  const std::filesystem::path& path() const { return folder_; }
  const std::string& only() const { return only_; }

  // Empty when the folder is not there.
  Listing List();

  // What McapReader::Open() takes. kNotFound with a sentence for people.
  base::Result<std::string> Find(const std::string& name) const;

 private:
  bool IsName(const std::string& name) const;
  // A file that is a recording by its name; empty: it is none.
  std::filesystem::path FileOf(const std::filesystem::path& path) const;
  RecordingLine Look(const std::string& name, const std::filesystem::path& file);

  const std::filesystem::path folder_;
  const std::string only_;
  base::Mutex mutex_;
  std::map<std::string, RecordingLine> known_ GSV_GUARDED_BY(mutex_);  // by name
};

}  // namespace gsv::gateway::recordings
