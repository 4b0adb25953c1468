// A file without a name, in memory, that two processes of one user map. The owner makes the file.
// The other process opens it through /proc. So the file needs no name, which would have to be
// removed later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "gsv/base/error.h"

namespace gsv::exchange {

// The address by which another process opens the file. `process` is a process id, and `descriptor`
// a file descriptor of that process.
struct FileAddress {
  std::uint32_t process = 0;
  std::uint32_t descriptor = 0;
};

// A mapped part of a shared file. The destructor unmaps it.
class Mapping {
 public:
  // Maps `size` bytes from `offset` on. The file must be large enough. `offset` is a multiple of
  // the page size.
  static base::Result<std::unique_ptr<Mapping>> Of(int descriptor, std::uint64_t offset,
                                                   std::size_t size);
  ~Mapping();
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  void* data() const { return data_; }

 private:
  Mapping(void* data, std::size_t size) : data_(data), size_(size) {}

  void* const data_;
  const std::size_t size_;
};

// An open shared file. The destructor closes it; mappings stay.
class SharedFile {
 public:
  // Makes an empty file that no process can make smaller, so that access to a mapping never fails.
  static base::Result<std::unique_ptr<SharedFile>> Make();
  // Opens a file of another process. Fails if the process or the file cannot be reached, for
  // example because it is on another host, in another container, or belongs to another user.
  static base::Result<std::unique_ptr<SharedFile>> Open(const FileAddress& address);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  // The address by which another process can open this file.
  FileAddress address() const;
  // Makes the file larger. New bytes are 0.
  base::Status Grow(std::uint64_t size);
  base::Result<std::uint64_t> size() const;
  // Maps a part of the file into the memory of this process.
  base::Result<std::unique_ptr<Mapping>> Map(std::uint64_t offset, std::size_t size) const {
    return Mapping::Of(descriptor_, offset, size);
  }
  // Returns the memory of a part of the file to the system. Its bytes become 0.
  void Free(std::uint64_t offset, std::size_t size) const;

 private:
  explicit SharedFile(int descriptor) : descriptor_(descriptor) {}

  const int descriptor_;
};

}  // namespace gsv::exchange
