// Reads arguments in the name of a xacro file: "robot.urdf.xacro?arm=true&prefix=left_".
#pragma once

#include <map>
#include <string>

namespace gsv::formats::xacro {

// A file name, split into the path and the arguments for xacro.
struct NamedFile {
  std::string file;                              // the path, without arguments
  std::map<std::string, std::string> arguments;  // empty if it is not a xacro file
};

// Returns the name without its arguments.
inline std::string FilePart(const std::string& name) {
  const std::size_t at = name.find(".xacro?");
  return at == std::string::npos ? name : name.substr(0, at + 6);
}

// Splits a name. Arguments are separated by "&"; "%20" and the like are decoded.
NamedFile SplitArguments(const std::string& name);

// Returns the name with slashes in its arguments written as %2F, so that it is one path.
std::string AsPath(const std::string& name);

}  // namespace gsv::formats::xacro
