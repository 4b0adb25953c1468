// A folder for a test's files, removed after the test.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "gsv/base/temporary_folder.h"

namespace gsv::base::testing {

class TestFolder {
 public:
  const std::filesystem::path& path() const { return folder_.path(); }

  // Creates a file and the folders in `name`. Returns the file's path.
  std::filesystem::path Write(const std::string& name, const std::string& content) const {
    const std::filesystem::path file = path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

 private:
  TemporaryFolder folder_ = TemporaryFolder::Make("gsv-test").value();
};

}  // namespace gsv::base::testing
