#include "gsv/formats/xacro/file_access.h"

#include <fnmatch.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include "gsv/base/sorting.h"
#include "gsv/formats/files/xml_text.h"
#include "gsv/formats/xacro/package_finder.h"
#include "gsv/formats/xacro/yaml_values.h"

namespace gsv::formats::xacro {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxIncludes = 512;
constexpr std::size_t kMaxYamlBytes = 4u << 20;

base::Failure<base::Error> NoFile(const std::string& why, const std::string& where = {}) {
  return base::Fail(base::ErrorCode::kBadModel, why, where);
}

// Returns the error for a missing file. All other errors are kBadModel.
base::Failure<base::Error> Missing(const std::string& why) {
  return base::Fail(base::ErrorCode::kNotFound, why);
}

}  // namespace

bool FileAccess::IsInPackage(const fs::path& file) const {
  const fs::path normal = file.lexically_normal();
  return std::any_of(packages_.begin(), packages_.end(), [&](const auto& package) {
    const fs::path& folder = package.second;
    return std::mismatch(folder.begin(), folder.end(), normal.begin(), normal.end()).first ==
           folder.end();
  });
}

base::Result<fs::path> FileAccess::Find(const std::string& name, const fs::path& in) const {
  std::error_code ignored;
  const std::string plain = name.starts_with("file://") ? name.substr(7) : name;
  const fs::path path(plain);
  if (path.is_absolute() && IsInPackage(path)) {
    if (fs::is_regular_file(path, ignored)) return path.lexically_normal();
    return Missing("there is no file " + plain);
  }
  const fs::path beside = fs::absolute(in, ignored).parent_path() / path;
  if (finder_.allows_absolute_paths() && fs::is_regular_file(beside, ignored)) {
    return beside.lexically_normal();
  }
  auto found = finder_.Find(plain, in);
  if (!found) return Missing(found.error().message);
  if (!fs::is_regular_file(*found, ignored)) return Missing(plain + " is not a file");
  return found;
}

base::Result<NodePtr> FileAccess::ReadIncluded(const std::string& name, const fs::path& in) {
  if (++includes_ > kMaxIncludes) {
    return NoFile("more than " + std::to_string(kMaxIncludes) + " files are included");
  }
  const auto file = Find(name, in);
  if (!file) return base::Fail(file.error());
  NodePtr& known = included_[*file];
  if (known != nullptr) return known;
  std::error_code error;
  const auto size = fs::file_size(*file, error);
  bytes_ += error ? 0 : size;
  if (error || bytes_ > limits_.xml_bytes) {
    return NoFile(
        "all files together exceed the limit of " + std::to_string(limits_.xml_bytes) + " bytes",
        file->string());
  }
  std::ifstream stream(*file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  tinyxml2::XMLDocument document;
  if (auto status = ParseXml(text, file->string(), limits_.xml_bytes, document, problems_);
      !status) {
    return base::Fail(status.error());
  }
  if (document.RootElement() == nullptr) {
    return NoFile("the file contains no XML element", file->string());
  }
  return known = ToNode(*document.RootElement(), std::make_shared<const fs::path>(*file));
}

std::vector<std::string> FileAccess::Matching(const std::string& pattern,
                                              const fs::path& in) const {
  std::error_code ignored;
  const fs::path path(pattern.starts_with("file://") ? pattern.substr(7) : pattern);
  const fs::path beside = fs::absolute(in, ignored).parent_path();
  const fs::path folder =
      (path.is_absolute() ? path : beside / path).parent_path().lexically_normal();
  std::vector<std::string> names;
  if (!IsInPackage(folder) && !finder_.allows_absolute_paths()) return names;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (fnmatch(path.filename().c_str(), entry.path().filename().c_str(), FNM_PERIOD) != 0)
      continue;
    if (names.size() < kMaxIncludes && entry.is_regular_file(ignored))
      names.push_back(entry.path().string());
  }
  base::Sort(names);
  return names;
}

base::Result<Value> FileAccess::ReadYaml(const std::string& name, const fs::path& in) {
  const auto file = Find(name, in);
  if (!file) return base::Fail(file.error());
  if (const auto known = yaml_.find(*file); known != yaml_.end()) return known->second;
  auto value = LoadYaml(*file, kMaxYamlBytes);
  if (value) yaml_[*file] = *value;
  return value;
}

base::Result<fs::path> FileAccess::Package(const std::string& name, const fs::path& in) {
  if (const auto known = packages_.find(name); known != packages_.end()) return known->second;
  auto found = FindPackage(name, in, finder_);
  if (!found) return Missing(found.error().message);
  return packages_[name] = found->lexically_normal();
}

}  // namespace gsv::formats::xacro
