#include "gsv/recording/mcap/file_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace gsv::recording {
namespace {

using base::ErrorCode;
using base::Fail;

std::string SystemMessage(int error) { return std::generic_category().message(error); }

base::Failure<base::Error> ReadsTooFar(std::string where) {
  return Fail(ErrorCode::kCorrupt, "the file refers to data beyond its end", std::move(where));
}

}  // namespace

FileDescriptor::~FileDescriptor() {
  if (fd_ >= 0) ::close(fd_);
}

base::Result<std::unique_ptr<FileSink>> FileSink::Create(std::string path, bool replace) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (file.get() < 0) {
    return Fail(ErrorCode::kUnavailable, "cannot create the recording: " + SystemMessage(errno),
                std::move(path));
  }
  struct stat status {};
  const bool is_file = ::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode);
  if (is_file && status.st_size > 0 && !replace) {
    return Fail(ErrorCode::kInvalidArgument,
                "the file exists already; give the recording another name or remove the file",
                std::move(path));
  }
  if (is_file && ::ftruncate(file.get(), 0) != 0) {
    return Fail(ErrorCode::kUnavailable, "cannot empty the file: " + SystemMessage(errno),
                std::move(path));
  }
  return std::unique_ptr<FileSink>(new FileSink(std::move(path), std::move(file)));
}

base::Status FileSink::Write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const bool full = errno == ENOSPC || errno == EDQUOT;
      return Fail(ErrorCode::kUnavailable,
                  "cannot write the recording: " + SystemMessage(errno) +
                      (full ? "; free some space and start another recording" : ""),
                  path_);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

base::Status FileSink::Sync() {
  // The error EINVAL means that the file is not on a disk (such as a pipe). This is no failure.
  if (::fdatasync(file_.get()) == 0 || errno == EINVAL) return {};
  return Fail(ErrorCode::kUnavailable,
              "cannot write the recording to its disk: " + SystemMessage(errno), path_);
}

base::Status FileSink::Truncate(std::uint64_t size) {
  const auto end = static_cast<off_t>(size);
  if (::ftruncate(file_.get(), end) == 0 && ::lseek(file_.get(), end, SEEK_SET) == end) return {};
  return Fail(ErrorCode::kUnavailable,
              "cannot truncate the file of the recording: " + SystemMessage(errno), path_);
}

base::Result<std::unique_ptr<FileSource>> FileSource::Open(std::string path) {
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) {
    const ErrorCode code = errno == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnavailable;
    return Fail(code, "cannot open the recording: " + SystemMessage(errno), std::move(path));
  }
  struct stat status {};
  if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    return Fail(ErrorCode::kInvalidArgument, "a recording (.mcap) must be a regular file",
                std::move(path));
  }
  return std::unique_ptr<FileSource>(
      new FileSource(std::move(path), std::move(file), static_cast<std::uint64_t>(status.st_size)));
}

base::Result<Bytes> FileSource::Read(std::uint64_t offset, std::uint64_t length) const {
  if (offset > size_ || length > size_ - offset) return ReadsTooFar(path_);
  Bytes bytes(length);
  for (std::size_t done = 0; done < length;) {
    const ssize_t size =
        ::pread(file_.get(), bytes.data() + done, length - done, static_cast<off_t>(offset + done));
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) {
      return Fail(ErrorCode::kUnavailable, "cannot read the recording: " + SystemMessage(errno),
                  path_);
    }
    if (size == 0) return ReadsTooFar(path_);  // the file was truncated after it was opened
    done += static_cast<std::size_t>(size);
  }
  return bytes;
}

base::Status MemorySink::Write(std::span<const std::byte> bytes) {
  PutBytes(out_, bytes);
  return {};
}

base::Status MemorySink::Truncate(std::uint64_t size) {
  out_.resize(size);
  return {};
}

base::Result<Bytes> MemorySource::Read(std::uint64_t offset, std::uint64_t length) const {
  if (offset > bytes_.size() || length > bytes_.size() - offset) return ReadsTooFar({});
  const std::span<const std::byte> part = bytes_.subspan(offset, length);
  return Bytes(part.begin(), part.end());
}

}  // namespace gsv::recording
