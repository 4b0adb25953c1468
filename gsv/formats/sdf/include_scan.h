// Finds, reads and repairs what a file includes before libsdformat sees it, so that each include is
// found from where it is written, and one that cannot be read costs no more than itself.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "gsv/base/error.h"
#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/sdf/included_files.h"
#include "gsv/formats/sdf/read_options.h"
#include "gsv/formats/sdf/sdf_xml.h"

namespace gsv::formats {

class IncludeScan {
 public:
  IncludeScan(const ResourceFinder& finder, const ReadLimits& limits, base::Problems& problems)
      : finder_(finder), limits_(limits), problems_(problems) {}

  // Looks for every <include> below `element` of `file`, and for those of the files that it names.
  // Their <uri> then names one of files(). Ground Plane and Sun take the place of their include where
  // no file is found. An include is taken out with a warning when its file is not there, cannot be
  // read, holds no model, or when the includes go round or deeper than the limit.
  void Scan(tinyxml2::XMLElement& element, const std::filesystem::path& file);

  // The file an <include> names; looked for once.
  base::Result<std::filesystem::path> FileOf(const std::string& uri,
                                             const std::filesystem::path& naming_file);

  // The repaired texts of all files that were found.
  const IncludedFiles& files() const { return files_; }

 private:
  void Visit(tinyxml2::XMLElement& element, const std::filesystem::path& file);
  base::Result<std::string> Enter(const std::filesystem::path& file);
  base::Result<std::string> TextOf(XmlFile& file);
  void ReplaceOrRemove(tinyxml2::XMLElement& include, const std::string& uri,
                       const base::Error& error, const std::filesystem::path& file);

  const ResourceFinder& finder_;
  const ReadLimits& limits_;
  base::Problems& problems_;
  IncludedFiles files_;
  std::map<std::pair<std::string, std::string>, base::Result<std::filesystem::path>> found_;
  std::vector<std::filesystem::path> open_;  // the chain of files being visited
  // For each file: its name in files_, or why there is none.
  std::map<std::filesystem::path, base::Result<std::string>> done_;
};

// The text of <include><uri>, without blanks around it.
std::string UriOf(const tinyxml2::XMLElement& include);

// Why an include that was not found is left out, as a sentence.
std::string IncludeLeftOut(const std::string& uri, const base::Error& error);

}  // namespace gsv::formats
