#include "gsv/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

namespace gsv::base {
namespace {

bool WriteAll(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool WriteDraft(const char* draft, std::string_view text, Durability durability) {
  const int descriptor = open(draft, O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0644);
  if (descriptor < 0) return false;
  const bool is_written =
      WriteAll(descriptor, text) && (durability == Durability::kProcess || fsync(descriptor) == 0);
  const int error = errno;
  const bool is_closed = close(descriptor) == 0;
  if (!is_written) errno = error;
  return is_written && is_closed;
}

}  // namespace

std::filesystem::path DraftPath(const std::filesystem::path& file, pid_t pid) {
  return file.string() + "." + std::to_string(pid) + ".draft";
}

Status WriteAtomically(const std::filesystem::path& file, std::string_view text,
                       Durability durability) {
  const std::filesystem::path draft = DraftPath(file, getpid());
  if (WriteDraft(draft.c_str(), text, durability) &&
      std::rename(draft.c_str(), file.c_str()) == 0) {
    return {};
  }
  const int error = errno;
  unlink(draft.c_str());
  return Fail(ErrorCode::kUnavailable, std::string("cannot be written: ") + std::strerror(error),
              file);
}

}  // namespace gsv::base
