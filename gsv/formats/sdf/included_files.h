// Provides the repaired texts of included files to libsdformat, as files in memory with names that
// GSV chooses.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace gsv::formats {

// The (repaired) text of a file. It has the same line numbers as the file.
struct SdfText {
  std::filesystem::path path;
  std::string text;
};

// Repaired texts of included files, by the text in the <uri> of the <include>.
using IncludedFiles = std::map<std::string, SdfText>;

// Provides texts as files in memory during the lifetime of this object, because libsdformat reads
// an included file only by its name.
//
// Errors   if the system has no memory for the repaired text, libsdformat reads the original file.
class IncludedFileServer {
 public:
  explicit IncludedFileServer(const IncludedFiles& files) : files_(files) {}
  ~IncludedFileServer();
  IncludedFileServer(const IncludedFileServer&) = delete;
  IncludedFileServer& operator=(const IncludedFileServer&) = delete;

  // Returns the name under which the text for `uri` can be read; empty if there is none.
  std::string Find(const std::string& uri);

  // Returns the file for a name that Find() has returned; null for other names.
  const std::filesystem::path* SourceOf(const std::string& name) const;

 private:
  // A file in memory, and the path of the file whose text it has.
  struct Served {
    int descriptor;
    std::filesystem::path path;
  };

  const IncludedFiles& files_;
  std::map<std::string, std::string> names_;  // by uri
  std::map<std::string, Served> served_;      // by name
};

}  // namespace gsv::formats
