// A FileAccess reads the files to which a xacro file refers, within limits on their place, number
// and size.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"
#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/xacro/node.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

// Reads the files to which a xacro file refers.
class FileAccess {
 public:
  FileAccess(const ResourceFinder& finder, const ReadLimits& limits, base::Problems& problems)
      : finder_(finder), limits_(limits), problems_(problems) {}

  // Returns the root of an included file. In all functions, `in` is the file that contains `name`.
  // Functions that return a Result fail with kNotFound if there is no such file or package, and
  // with kBadModel if the file or package cannot be used.
  base::Result<NodePtr> ReadIncluded(const std::string& name, const std::filesystem::path& in);
  // Returns the files whose names match a pattern with *, ? or [] in its last part, in the order of
  // their names.
  std::vector<std::string> Matching(const std::string& pattern,
                                    const std::filesystem::path& in) const;
  // Reads a YAML file.
  base::Result<Value> ReadYaml(const std::string& name, const std::filesystem::path& in);
  // Returns the folder of a ROS package.
  base::Result<std::filesystem::path> Package(const std::string& name,
                                              const std::filesystem::path& in);

 private:
  // Finds a file.
  base::Result<std::filesystem::path> Find(const std::string& name,
                                           const std::filesystem::path& in) const;
  // Whether the file is in a folder that Package() has returned.
  bool IsInPackage(const std::filesystem::path& file) const;

  const ResourceFinder& finder_;
  const ReadLimits& limits_;
  base::Problems& problems_;
  std::map<std::string, std::filesystem::path> packages_;  // folders of ROS packages, by name
  std::map<std::filesystem::path, NodePtr> included_;      // roots of included files, by path
  std::map<std::filesystem::path, Value> yaml_;            // contents of YAML files, by path
  std::size_t bytes_ = 0;                                  // number of bytes that were read
  int includes_ = 0;                                       // number of included files
};

}  // namespace gsv::formats::xacro
