// Outputs and inputs of recordings: files, or memory in tests.
//
// Errors  kUnavailable with the path and the error of the system.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "gsv/base/error.h"
#include "gsv/recording/mcap/byte_order.h"

namespace gsv::recording {

// An output for bytes. Sync() may be called while another thread writes.
class ByteSink {
 public:
  virtual ~ByteSink() = default;
  // Writes all bytes. After an error, a part may have been written.
  [[nodiscard]] virtual base::Status Write(std::span<const std::byte> bytes) = 0;
  // Returns when all written bytes are on the disk, so that they survive a loss of power.
  [[nodiscard]] virtual base::Status Sync() = 0;
  // Truncates the output to its first `size` bytes. An output in memory may ignore the call.
  [[nodiscard]] virtual base::Status Truncate(std::uint64_t size) = 0;
};

// An input of known size that can be read at any offset. Const members may run concurrently.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual std::uint64_t size() const = 0;
  // Reads `length` bytes from `offset` on. Returns kCorrupt if the input has fewer.
  [[nodiscard]] virtual base::Result<Bytes> Read(std::uint64_t offset,
                                                 std::uint64_t length) const = 0;
};

// Owns an open file.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;  // -1 after a move
};

class FileSink : public ByteSink {
 public:
  // Creates the file. Fails with kInvalidArgument if the file exists and is not empty, unless
  // `replace` is true.
  [[nodiscard]] static base::Result<std::unique_ptr<FileSink>> Create(std::string path,
                                                                      bool replace);

  base::Status Write(std::span<const std::byte> bytes) override;
  base::Status Sync() override;
  base::Status Truncate(std::uint64_t size) override;

 private:
  FileSink(std::string path, FileDescriptor file)
      : path_(std::move(path)), file_(std::move(file)) {}

  std::string path_;
  FileDescriptor file_;
};

class FileSource : public ByteSource {
 public:
  // Opens a file for reading.
  [[nodiscard]] static base::Result<std::unique_ptr<FileSource>> Open(std::string path);

  std::uint64_t size() const override { return size_; }
  base::Result<Bytes> Read(std::uint64_t offset, std::uint64_t length) const override;

 private:
  FileSource(std::string path, FileDescriptor file, std::uint64_t size)
      : path_(std::move(path)), file_(std::move(file)), size_(size) {}

  std::string path_;
  FileDescriptor file_;
  std::uint64_t size_;
};

class MemorySink : public ByteSink {
 public:
  // `out` must outlive the sink.
  explicit MemorySink(Bytes& out) : out_(out) {}
  base::Status Write(std::span<const std::byte> bytes) override;
  base::Status Sync() override { return {}; }
  base::Status Truncate(std::uint64_t size) override;

 private:
  Bytes& out_;  // the written bytes
};

class MemorySource : public ByteSource {
 public:
  // `bytes` must outlive the source.
  explicit MemorySource(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return bytes_.size(); }
  base::Result<Bytes> Read(std::uint64_t offset, std::uint64_t length) const override;

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace gsv::recording
