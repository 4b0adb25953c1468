#include "gsv/base/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace gsv::base {

Result<TemporaryFolder> TemporaryFolder::Make(const std::string& prefix) {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  std::string name = (parent / (prefix + "-XXXXXX")).string();
  if (!error && mkdtemp(name.data()) == nullptr) error = {errno, std::generic_category()};
  if (error) {
    return Fail(ErrorCode::kUnavailable,
                "no temporary folder can be made (TMPDIR chooses where): " + error.message(),
                parent.string());
  }
  return TemporaryFolder(name);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace gsv::base
