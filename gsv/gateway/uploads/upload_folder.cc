#include "gsv/gateway/uploads/upload_folder.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

namespace gsv::gateway::uploads {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFileNameLength = 200;

bool IsName(const std::string& name) {
  const bool is_plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c >= 0x20 && c != 0x7f && c != '/' && c != '\\';
  });
  return is_plain && !name.empty() && name.size() <= kMaxFileNameLength && name.front() != '.';
}

std::uint64_t NumberOf(const std::string& set) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(set.data(), set.data() + set.size(), number);
  return error == std::errc() && end == set.data() + set.size() ? number : 0;
}

}  // namespace

base::Result<std::string> UploadFolder::Begin() {
  const base::MutexLock lock(mutex_);
  if (!folder_) {
    auto made = base::TemporaryFolder::Make("gsv-uploads");
    if (!made) return base::Fail(made.error());
    folder_.emplace(*std::move(made));
  }
  if (sets_ >= limits_.files) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "the space for uploads is full; restart the server to empty it");
  }
  return std::to_string(++sets_);
}

base::Result<fs::path> UploadFolder::Put(const std::string& set,
                                         const std::vector<std::string>& path,
                                         std::string_view content) {
  const base::MutexLock lock(mutex_);
  const std::uint64_t number = NumberOf(set);
  if (number == 0 || number > sets_) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "this upload does not exist any more; upload the files again");
  }
  if (path.empty() || path.size() > limits_.depth) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the path of a file must have 1 to " + std::to_string(limits_.depth) +
                          " names, but it has " + std::to_string(path.size()));
  }
  if (const auto bad = std::find_if_not(path.begin(), path.end(), IsName); bad != path.end()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the name '" + bad->substr(0, kMaxFileNameLength) +
                          "' cannot be used: a name must have 1 to 200 characters, none of them a "
                          "slash or a control character, and must not begin with a dot");
  }
  if (files_ >= limits_.files || content.size() > limits_.bytes - bytes_) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "the space for uploads is full; restart the server to empty it");
  }
  fs::path file = folder_->path() / std::to_string(number);
  for (const std::string& name : path) file /= name;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (error || !out) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "cannot write the file " + file.filename().string() + ": " +
                          (error ? error.message() : std::strerror(errno)));
  }
  files_ += 1;
  bytes_ += content.size();
  return file;
}

}  // namespace gsv::gateway::uploads
