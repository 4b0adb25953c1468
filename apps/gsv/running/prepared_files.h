// Worlds and models that a process has read before it forks for a run. Each file is read once, so
// later changes of the file have no effect.
//
// Threads  one at a time. This class starts no thread.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/gsv/running/run_options.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::app {

class PreparedFiles {
 public:
  // Reads the world and the models of a run with these options, and sets them in the options. Files
  // that cannot be read here are left to the run, which reports their problems.
  void Provide(RunOptions& options);

 private:
  // The options for reading. Files that were read with other options are not used.
  struct Key {
    std::vector<std::filesystem::path> model_path;
    std::map<std::string, std::string> drives;   // see ReadOptions::drives
    std::vector<std::filesystem::path> plugins;  // plug-ins with sensor types
    formats::ReadLimits limits;
    bool operator==(const Key&) const = default;
  };

  // Returns the world of a file, and reads it on first use. Null if it cannot be read.
  std::shared_ptr<const PreparedWorld> WorldAt(const std::string& file);

  Key key_;  // the options with which library_ has read files
  std::shared_ptr<formats::ModelLibrary> library_;                      // null if nothing was read
  std::map<std::string, std::shared_ptr<const PreparedWorld>> worlds_;  // by file
};

}  // namespace gsv::app
