#include "gsv/base/user_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace gsv::base {
namespace {

std::filesystem::path Place() {
  if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime != nullptr && *runtime == '/')
    return std::filesystem::path(runtime) / "gsv";
  return "/tmp/gsv-" + std::to_string(geteuid());
}

}  // namespace

Result<std::filesystem::path> UserFolder() {
  std::filesystem::path folder = Place();
  // The result is ignored: mkdir() fails if the folder exists already, and the checks below detect
  // all other problems.
  mkdir(folder.c_str(), 0700);
  struct stat status {};
  if (lstat(folder.c_str(), &status) != 0)
    return Fail(ErrorCode::kUnavailable, std::strerror(errno), folder);
  if (!S_ISDIR(status.st_mode) || status.st_uid != geteuid() || (status.st_mode & 022) != 0) {
    return Fail(ErrorCode::kUnavailable,
                "expected a folder that only this user can write to; remove it", folder);
  }
  return folder;
}

}  // namespace gsv::base
