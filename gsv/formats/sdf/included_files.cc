#include "gsv/formats/sdf/included_files.h"

#include <sys/mman.h>
#include <unistd.h>

namespace gsv::formats {
namespace {

// Returns a descriptor of a file in memory with the text; -1 if there is no memory.
int InMemory(const std::string& text) {
  const int descriptor = memfd_create("gsv-include", MFD_CLOEXEC);
  if (descriptor < 0) return -1;
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(descriptor, text.data() + done, text.size() - done);
    if (written <= 0) {
      close(descriptor);
      return -1;
    }
    done += static_cast<std::size_t>(written);
  }
  return descriptor;
}

}  // namespace

IncludedFileServer::~IncludedFileServer() {
  for (const auto& [name, served] : served_) close(served.descriptor);
}

std::string IncludedFileServer::Find(const std::string& uri) {
  if (const auto known = names_.find(uri); known != names_.end()) return known->second;
  const auto file = files_.find(uri);
  if (file == files_.end()) return "";
  std::string& name = names_[uri];
  const int descriptor = InMemory(file->second.text);
  if (descriptor < 0) return name = file->second.path.string();
  name = "/proc/self/fd/" + std::to_string(descriptor);
  served_[name] = {descriptor, file->second.path};
  return name;
}

const std::filesystem::path* IncludedFileServer::SourceOf(const std::string& name) const {
  const auto served = served_.find(name);
  return served == served_.end() ? nullptr : &served->second.path;
}

}  // namespace gsv::formats
