#include "gsv/orb/local_socket.h"

#include <sys/un.h>
#include <unistd.h>

#include <cctype>
#include <random>
#include <string>

#include <fmt/format.h>

#include "gsv/base/user_folder.h"

namespace gsv::orb {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".socket";  // socket files are called PID-RANDOM.socket

bool IsLeftBehind(const fs::path& file) {
  if (file.extension() != kExtension) return false;
  const std::string name = file.filename();
  const std::string pid = name.substr(0, name.find('-'));
  std::error_code ignored;
  return !fs::exists(fs::path("/proc") / pid, ignored);
}

}  // namespace

base::Result<fs::path> NewLocalSocket() {
  const auto folder = base::UserFolder();
  if (!folder) return base::Fail(folder.error());
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(*folder, ignored)) {
    if (IsLeftBehind(entry.path())) fs::remove(entry.path(), ignored);
  }
  std::random_device random;
  fs::path path = *folder / fmt::format("{}-{:08x}{}", getpid(), random(), kExtension);
  if (path.native().size() >= sizeof(sockaddr_un::sun_path)) {
    return base::Fail(base::ErrorCode::kUnavailable, "the path is too long for a socket", path);
  }
  return path;
}

}  // namespace gsv::orb
