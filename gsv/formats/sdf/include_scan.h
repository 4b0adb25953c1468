// An IncludeScan finds, reads and repairs included files before libsdformat reads them. Each
// included file is searched relative to the file that includes it. Only unreadable includes are
// left out.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

#include "gsv/base/error.h"
#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/sdf/included_files.h"
#include "gsv/formats/sdf/read_options.h"
#include "gsv/formats/sdf/sdf_xml.h"

namespace gsv::formats {

// Inserts a built-in model after an <include>, with the name and the pose of the <include>. `text` is
// a <model> or a <light>.
void InsertBuiltIn(tinyxml2::XMLElement& include, std::string_view text);

// Finds, reads and repairs included files.
class IncludeScan {
 public:
  IncludeScan(const ResourceFinder& finder, const ReadLimits& limits, base::Problems& problems)
      : finder_(finder), limits_(limits), problems_(problems) {}

  // Visits every <include> below `element` of `file`, and the <include>s in the included files.
  // Changes their <uri> to a name in files(). If no file is found for Ground Plane or Sun, the
  // built-in model replaces the include. An include is removed with a warning if its file is
  // missing, cannot be read or has no model. Includes that form a cycle or exceed the depth limit
  // are removed as well.
  void Scan(tinyxml2::XMLElement& element, const std::filesystem::path& file);

  // Returns the path of an <include>'s file. Each name is searched once.
  base::Result<std::filesystem::path> FileOf(const std::string& uri,
                                             const std::filesystem::path& naming_file);

  // The repaired texts of all found files.
  const IncludedFiles& files() const { return files_; }

 private:
  // Processes the <include>s below `element`, and the <include>s in the models below it.
  void Visit(tinyxml2::XMLElement& element, const std::filesystem::path& file);
  // Reads an included file with its own includes. Returns its name in files().
  base::Result<std::string> ReadIncluded(const std::filesystem::path& file);
  // Returns the repaired text of an included file. Fails if the file contains no model.
  base::Result<std::string> TextOf(XmlFile& file);
  // Replaces an <include> by a built-in model, or removes it, with a warning
  // unless it is the built-in sun.
  void ReplaceOrRemove(tinyxml2::XMLElement& include, const std::string& uri,
                       const base::Error& error, const std::filesystem::path& file);

  const ResourceFinder& finder_;
  const ReadLimits& limits_;
  base::Problems& problems_;
  IncludedFiles files_;
  // The results of FileOf(), by its arguments.
  std::map<std::pair<std::string, std::string>, base::Result<std::filesystem::path>> found_;
  // the chain of files that are being read; a file that includes one of them forms a cycle
  std::vector<std::filesystem::path> open_;
  // For each file: its name in files_, or the reason why the file is not in files_.
  std::map<std::filesystem::path, base::Result<std::string>> done_;
};

// Returns the text of <include><uri>, without surrounding blanks.
std::string UriOf(const tinyxml2::XMLElement& include);

// Returns the warning that an include is left out because of this error.
std::string IncludeLeftOut(const std::string& uri, const base::Error& error);

}  // namespace gsv::formats
