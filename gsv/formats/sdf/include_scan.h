// Finds what a file includes before libsdformat reads it, so that includes which go round or are
// absent are noticed here.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "gsv/base/error.h"
#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/sdf/read_options.h"

namespace gsv::formats {

class IncludeScan {
 public:
  IncludeScan(const ResourceFinder& finder, const ReadLimits& limits, base::Problems& problems)
      : finder_(finder), limits_(limits), problems_(problems) {}

  // Looks for every <include> below `element` of `file`. Ground Plane and Sun take the place of
  // their include where no file is found; any other that is not found is taken out with a warning.
  // Fails when includes go round or deeper than the limit.
  base::Status Scan(tinyxml2::XMLElement& element, const std::filesystem::path& file);

  // The file an <include> names; looked for once.
  base::Result<std::filesystem::path> FileOf(const std::string& uri,
                                             const std::filesystem::path& naming_file);

  // Each <uri> as it is written, and its file.
  const std::map<std::string, std::filesystem::path>& files() const { return files_; }

 private:
  base::Status Visit(tinyxml2::XMLElement& element, const std::filesystem::path& file);
  base::Status Enter(const std::filesystem::path& file);
  void ReplaceOrRemove(tinyxml2::XMLElement& include, const std::string& uri,
                       const base::Error& error, const std::filesystem::path& file);

  const ResourceFinder& finder_;
  const ReadLimits& limits_;
  base::Problems& problems_;
  std::map<std::string, std::filesystem::path> files_;
  std::map<std::pair<std::string, std::string>, base::Result<std::filesystem::path>> found_;
  std::vector<std::filesystem::path> open_;  // the chain of files being visited
  std::map<std::filesystem::path, bool> done_;
};

// The text of <include><uri>, without blanks around it.
std::string UriOf(const tinyxml2::XMLElement& include);

// Why an include that was not found is left out, as a sentence.
std::string IncludeLeftOut(const std::string& uri, const base::Error& error);

}  // namespace gsv::formats
