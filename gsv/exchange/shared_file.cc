#include "gsv/exchange/shared_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace gsv::exchange {
namespace {

constexpr const char* kName = "gsv-exchange";  // shown in /proc/PID/maps

base::Error Unavailable(const std::string& what) {
  return {base::ErrorCode::kUnavailable, what + ": " + std::strerror(errno), "shared memory"};
}

}  // namespace

base::Result<std::unique_ptr<Mapping>> Mapping::Of(int descriptor, std::uint64_t offset,
                                                   std::size_t size) {
  void* const data = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor,
                          static_cast<off_t>(offset));
  if (data == MAP_FAILED) return base::Fail(Unavailable("cannot map"));
  return std::unique_ptr<Mapping>(new Mapping(data, size));
}

Mapping::~Mapping() { munmap(data_, size_); }

base::Result<std::unique_ptr<SharedFile>> SharedFile::Make() {
  const int descriptor = memfd_create(kName, MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor < 0) return base::Fail(Unavailable("cannot make a file"));
  std::unique_ptr<SharedFile> file(new SharedFile(descriptor));
  if (fcntl(descriptor, F_ADD_SEALS, F_SEAL_SHRINK) != 0) {
    return base::Fail(Unavailable("cannot seal the file against shrinking"));
  }
  return file;
}

base::Result<std::unique_ptr<SharedFile>> SharedFile::Open(const FileAddress& address) {
  const std::string path =
      "/proc/" + std::to_string(address.process) + "/fd/" + std::to_string(address.descriptor);
  // In another container, this process id and descriptor may belong to a pipe. O_NONBLOCK keeps
  // open() from waiting for the other end of the pipe.
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return base::Fail(Unavailable("cannot open " + path));
  std::unique_ptr<SharedFile> file(new SharedFile(descriptor));
  const int seals = fcntl(descriptor, F_GET_SEALS);
  if (seals < 0 || (seals & F_SEAL_SHRINK) == 0) {
    return base::Fail(base::ErrorCode::kUnavailable, "is no shared memory", path);
  }
  return file;
}

SharedFile::~SharedFile() { close(descriptor_); }

FileAddress SharedFile::address() const {
  return {static_cast<std::uint32_t>(getpid()), static_cast<std::uint32_t>(descriptor_)};
}

base::Status SharedFile::Grow(std::uint64_t size) {
  if (ftruncate(descriptor_, static_cast<off_t>(size)) == 0) return {};
  return base::Fail(Unavailable("cannot grow"));
}

base::Result<std::uint64_t> SharedFile::size() const {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) return base::Fail(Unavailable("cannot get the size"));
  return static_cast<std::uint64_t>(status.st_size);
}

void SharedFile::Free(std::uint64_t offset, std::size_t size) const {
  (void)fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE,
                  static_cast<off_t>(offset), static_cast<off_t>(size));
}

}  // namespace gsv::exchange
