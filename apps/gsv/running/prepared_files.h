// Worlds and models that a process has read before it forks for a run. A file is read once: later
// changes of it have no effect.
//
// Threads  one at a time. Starts no thread.
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
  // Reads the world and the models of a run with these options, and puts them into the options. The
  // run itself reads what cannot be read here, and reports what is wrong with it.
  void Provide(RunOptions& options);

 private:
  // How files are read; what was read in another way is no use.
  struct Key {
    std::vector<std::filesystem::path> model_path;
    std::map<std::string, std::string> drives;
    std::vector<std::filesystem::path> plugins;
    formats::ReadLimits limits;
    bool operator==(const Key&) const = default;
  };

  std::shared_ptr<const PreparedWorld> WorldAt(const std::string& file);

  Key key_;
  std::shared_ptr<formats::ModelLibrary> library_;  // null: nothing was read yet
  std::map<std::string, std::shared_ptr<const PreparedWorld>> worlds_;  // by file
};

}  // namespace gsv::app
