// The files that a document includes, as libsdformat is to read them: as repaired text that lies in
// memory, under names of our own.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace gsv::formats {

// A text, and the file it comes from. Its lines are the file's.
struct SdfText {
  std::filesystem::path path;
  std::string text;
};

using IncludedFiles = std::map<std::string, SdfText>;  // by what an <include>'s <uri> names

// Hands texts out as files. libsdformat reads an included file by its name only, so each text gets
// one that exists in memory, for as long as this object lives.
//
// Errors   a text that memory has no room for is read from its own file.
class IncludedFileServer {
 public:
  explicit IncludedFileServer(const IncludedFiles& files) : files_(files) {}
  ~IncludedFileServer();
  IncludedFileServer(const IncludedFileServer&) = delete;
  IncludedFileServer& operator=(const IncludedFileServer&) = delete;

  // The name under which the text for `uri` can be read; empty when there is none.
  std::string Find(const std::string& uri);

  // The file for which a name that Find() gave stands; null for other names.
  const std::filesystem::path* SourceOf(const std::string& name) const;

 private:
  struct Served {
    int descriptor;
    std::filesystem::path path;
  };

  const IncludedFiles& files_;
  std::map<std::string, std::string> names_;  // by uri
  std::map<std::string, Served> served_;      // by name
};

}  // namespace gsv::formats
