// A ResourceFinder finds the files to which worlds and robots refer.
//
// A name is `model://NAME/REST`, `package://NAME/REST`, `file://PATH`, a bare path, or an address
// on the web. A relative path is searched beside the file that names it, and then in the folders of
// steps 1 to 4. `model://NAME/REST` is searched in this order:
//   1. beside the naming file, in each of its parent folders (five up), and in the `models` folder
//      of each of these folders;
//   2. on the search path of the caller;
//   3. on GZ_SIM_RESOURCE_PATH, SDF_PATH, IGN_GAZEBO_RESOURCE_PATH and GAZEBO_MODEL_PATH;
//   4. among the built-in models;
//   5. in the ROS package of that name (package.xml) that contains the naming file, or in a ROS
//      package near it.
// If no name matches unchanged, "%20" and the like are decoded. For an address on the web, the
// model's name is searched as model://NAME. Backslashes count as slashes. Case is ignored if no
// name matches.
//
// Safety   a name that leaves the folder in which it is searched (`..`) is refused; a relative path
//          may lead to the parent of the naming file's folder, where sibling models are. Absolute
//          paths are refused unless `allow_absolute_paths`.
// Errors   kNotFound; the message contains the name.
// Threads  const members may run concurrently.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::formats {

// Finds the files to which worlds and robots refer.
class ResourceFinder {
 public:
  explicit ResourceFinder(std::vector<std::filesystem::path> search_path = {},
                          bool allow_absolute_paths = true);

  // Finds a file. `naming_file` is the file that contains the name. If it is empty, the file is
  // searched as if the name were in a file of the current folder.
  base::Result<std::filesystem::path> Find(std::string_view name,
                                           const std::filesystem::path& naming_file = {}) const;
  // Returns the names of the built-in models and the models on the search path, at most 10,000.
  // Callers suggest them for a misspelt name. The names of each folder are in alphabetical order.
  std::vector<std::string> ModelNames() const;
  // The folders in which models are searched, in order: steps 2, 3 and 4 above.
  const std::vector<std::filesystem::path>& search_path() const { return search_path_; }
  bool allows_absolute_paths() const { return allow_absolute_paths_; }

 private:
  // Returns the folders in which models are searched for a name in this file.
  std::vector<std::filesystem::path> FoldersFor(const std::filesystem::path& naming_file) const;
  // Finds the path of a model:// name.
  base::Result<std::filesystem::path> FindInModels(const std::string& path,
                                                   const std::filesystem::path& naming_file) const;
  // Finds a relative or absolute path.
  base::Result<std::filesystem::path> FindByPath(const std::string& path,
                                                 const std::filesystem::path& naming_file) const;

  std::vector<std::filesystem::path>
      search_path_;  // folders of the caller, the environment, and GSV
  bool allow_absolute_paths_;
};

// Finds a relative path in the folder of `naming_file`, or up to two folders above it.
base::Result<std::filesystem::path> FindBeside(const std::string& name,
                                               const std::filesystem::path& naming_file);

// Whether the name begins with http:// or https://.
bool IsWebAddress(std::string_view name);

// Returns the model file in `folder`. If its model.config lists several files, this is the file
// with the newest SDFormat version from 1.3 to 1.9. If there is none, this is a file with a version
// above 1.9, or else model.sdf.
base::Result<std::filesystem::path> ModelFileIn(const std::filesystem::path& folder);

}  // namespace gsv::formats
