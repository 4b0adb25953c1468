#include "gsv/formats/files/resource_finder.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <span>
#include <sstream>
#include <system_error>

#include <tinyxml2.h>

#include "gsv/base/sorting.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using base::ErrorCode;

constexpr int kParentsSearched = 5;
constexpr std::size_t kMaxNameLength = 4096;
// A ROS package is searched in kPackageParents folders: the folder of the naming file, and the
// folders above it. In each of these folders, at most kMaxGroups subfolders are searched.
constexpr int kPackageParents = 4;
constexpr std::size_t kMaxGroups = 200;
constexpr std::uintmax_t kMaxPackageFileBytes = 1u << 20;

bool StartsWith(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

bool EqualsIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

bool Exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

std::vector<fs::path> PathFromEnvironment() {
  std::vector<fs::path> folders;
  for (const char* variable :
       {"GZ_SIM_RESOURCE_PATH", "SDF_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH"}) {
    const char* value = std::getenv(variable);
    if (value == nullptr) continue;
    std::istringstream list(value);
    for (std::string folder; std::getline(list, folder, ':');) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  return folders;
}

// Returns the folder of the built-in models, found from the program's path: assets/models of the
// source tree, or share/gsv/models of an installation.
std::vector<fs::path> BuiltInModels() {
  std::error_code ignored;
  fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (int level = 0; level < 4 && folder.has_relative_path(); ++level) {
    for (const char* place : {"assets/models", "share/gsv/models"}) {
      if (Exists(folder / place)) return {folder / place};
    }
    folder = folder.parent_path();
  }
  return {};
}

// Returns `folder`/`relative`, or else a path below `folder` whose names differ only in case.
std::optional<fs::path> FindBelow(const fs::path& folder, const fs::path& relative) {
  if (Exists(folder / relative)) return (folder / relative).lexically_normal();
  fs::path found = folder;
  for (const fs::path& name : relative) {
    if (Exists(found / name)) {
      found /= name;
      continue;
    }
    std::error_code error;
    std::vector<fs::path> alike;
    for (const auto& entry : fs::directory_iterator(found, error)) {
      if (EqualsIgnoringCase(entry.path().filename().string(), name.string())) {
        alike.push_back(entry.path());
      }
    }
    if (alike.empty()) return std::nullopt;
    found = *std::min_element(alike.begin(), alike.end());
  }
  return found.lexically_normal();
}

bool ClimbsOut(const fs::path& relative) {
  const fs::path normal = relative.lexically_normal();
  return normal.is_absolute() || (!normal.empty() && *normal.begin() == "..");
}

// Decodes "%20" and the like, which web tools write into file names.
std::string PercentDecoded(const std::string& text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() &&
        std::isxdigit(static_cast<unsigned char>(text[i + 1])) &&
        std::isxdigit(static_cast<unsigned char>(text[i + 2]))) {
      decoded += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

std::string WithoutLeadingSlashes(std::string path) {
  path.erase(0, std::min(path.find_first_not_of('/'), path.size()));
  return path;
}

std::string TrimmedName(std::string_view text) {
  constexpr char kBlanks[] = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

// Returns "NAME/REST" for https://fuel.gazebosim.org/1.0/OWNER/models/NAME[/VERSION[/files/REST]],
// and an empty text for other addresses.
std::string ModelOfWebAddress(const std::string& address) {
  constexpr char kModels[] = "/models/";
  const std::size_t models = address.find(kModels);
  if (models == std::string::npos) return "";
  std::string path = address.substr(models + sizeof kModels - 1);
  const std::size_t name_end = std::min(path.find('/'), path.size());
  const std::string name = path.substr(0, name_end);
  constexpr char kFiles[] = "/files/";
  const std::size_t files = path.find(kFiles);
  if (files == std::string::npos) return name;
  return name + "/" + path.substr(files + sizeof kFiles - 1);
}

// Returns the name in a folder's package.xml; empty if there is no such file.
std::string PackageName(const fs::path& folder) {
  const fs::path file = folder / "package.xml";
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > kMaxPackageFileBytes) {
    return "";
  }
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) return "";
  const auto* root = document.RootElement();
  const auto* name = root == nullptr ? nullptr : root->FirstChildElement("name");
  return name == nullptr || name->GetText() == nullptr ? "" : TrimmedName(name->GetText());
}

// Finds "PACKAGE/REST" in a ROS package near the naming file. Searches the naming file's folder and
// the folders above it. Such a folder is the package if its package.xml names PACKAGE. The name of
// the folder itself does not matter. If FOLDER is one of the searched folders, a folder
// FOLDER/ANY/PACKAGE is also accepted, even without a package.xml.
std::optional<fs::path> FindInPackage(const fs::path& path, const fs::path& naming_file) {
  if (naming_file.empty() || path.empty()) return std::nullopt;
  const fs::path package = *path.begin();
  const fs::path rest = path.lexically_relative(package);
  std::error_code error;
  fs::path folder = fs::absolute(naming_file, error).lexically_normal().parent_path();
  for (int level = 0; level < kPackageParents && folder.has_relative_path(); ++level) {
    if (PackageName(folder) == package.string()) {
      if (auto found = FindBelow(folder, rest)) return found;
    }
    std::vector<fs::path> groups;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (groups.size() >= kMaxGroups) break;
      if (entry.is_directory(error)) groups.push_back(entry.path());
    }
    base::Sort(groups);
    for (const fs::path& group : groups) {
      if (!Exists(group / package)) continue;
      if (auto found = FindBelow(group, path)) return found;
    }
    folder = folder.parent_path();
  }
  return std::nullopt;
}

// Returns version "1.5" as 105; 0 for a text that is not a version.
int VersionNumber(const char* text) {
  int major = 0, minor = 0;
  if (text == nullptr || std::sscanf(text, "%d.%d", &major, &minor) != 2) return 0;
  return major * 100 + minor;
}

bool HoldsAModel(const fs::path& folder) {
  std::error_code error;
  const fs::directory_iterator files(folder, error);
  return std::any_of(begin(files), end(files), [](const fs::directory_entry& file) {
    const fs::path extension = file.path().extension();
    return extension == ".sdf" || extension == ".urdf" || extension == ".xacro";
  });
}

}  // namespace

bool IsWebAddress(std::string_view name) {
  return StartsWith(name, "http://") || StartsWith(name, "https://");
}

base::Result<fs::path> FindBeside(const std::string& name, const fs::path& naming_file) {
  std::string path = name;
  std::replace(path.begin(), path.end(), '\\', '/');
  std::error_code ignored;
  const fs::path here = fs::absolute(naming_file, ignored).lexically_normal().parent_path();
  const fs::path from_above = here.parent_path().filename() / here.filename() / path;
  if (path.size() <= kMaxNameLength && fs::path(path).is_relative() && !ClimbsOut(from_above)) {
    if (auto found = FindBelow(here, path)) return *found;
  }
  return Fail(ErrorCode::kNotFound, "cannot find " + name, naming_file.string());
}

ResourceFinder::ResourceFinder(std::vector<fs::path> search_path, bool allow_absolute_paths)
    : search_path_(std::move(search_path)), allow_absolute_paths_(allow_absolute_paths) {
  for (const auto& more : {PathFromEnvironment(), BuiltInModels()}) {
    search_path_.insert(search_path_.end(), more.begin(), more.end());
  }
}

std::vector<std::string> ResourceFinder::ModelNames() const {
  constexpr std::size_t kMaxNames = 10'000;
  std::vector<std::string> names;
  for (const fs::path& folder : search_path_) {
    const std::size_t first = names.size();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (names.size() >= kMaxNames) break;
      if (HoldsAModel(entry.path())) names.push_back(entry.path().filename());
    }
    base::Sort(std::span(names).subspan(first));
  }
  return names;
}

base::Result<fs::path> ResourceFinder::Find(std::string_view name,
                                            const fs::path& naming_file) const {
  std::string path = TrimmedName(name);
  if (path.empty()) return Fail(ErrorCode::kNotFound, "the file name is empty");
  if (path.size() > kMaxNameLength) {
    return Fail(ErrorCode::kNotFound,
                "the file name is longer than " + std::to_string(kMaxNameLength) + " bytes");
  }
  if (path.find('\0') != std::string::npos) {
    return Fail(ErrorCode::kNotFound, "the file name contains a zero byte");
  }
  if (IsWebAddress(path)) {
    const std::string model = ModelOfWebAddress(path);
    if (!model.empty()) {
      if (auto found = FindInModels(model, naming_file)) return found;
    }
    return Fail(ErrorCode::kNotFound,
                path + " is on the web, where gsv does not search; put a copy on the model path");
  }
  std::replace(path.begin(), path.end(), '\\', '/');
  for (const std::string scheme : {"model://", "package://"}) {
    if (StartsWith(path, scheme)) {
      return FindInModels(WithoutLeadingSlashes(path.substr(scheme.size())), naming_file);
    }
  }
  if (StartsWith(path, "file://")) path = PercentDecoded(path.substr(7));
  return FindByPath(path, naming_file);
}

base::Result<fs::path> ResourceFinder::FindInModels(const std::string& path,
                                                    const fs::path& naming_file) const {
  const std::string decoded = PercentDecoded(path);
  if (ClimbsOut(path) || ClimbsOut(decoded) || decoded.find('\0') != std::string::npos) {
    return Fail(ErrorCode::kNotFound, "model://" + path + " is outside the model folders");
  }
  const std::vector<fs::path> folders = FoldersFor(naming_file);
  for (const std::string& each : {path, decoded}) {
    for (const fs::path& folder : folders) {
      if (auto found = FindBelow(folder, each)) return *found;
    }
    if (path == decoded) break;
  }
  if (auto found = FindInPackage(decoded, naming_file)) return *found;
  return Fail(ErrorCode::kNotFound,
              "cannot find model://" + path + " beside the file or on the model path");
}

base::Result<fs::path> ResourceFinder::FindByPath(const std::string& path,
                                                  const fs::path& naming_file) const {
  const fs::path relative(path);
  if (relative.is_absolute()) {
    if (!allow_absolute_paths_) {
      return Fail(ErrorCode::kNotFound,
                  path + " is an absolute path; only relative paths are allowed here");
    }
    if (auto found = FindBelow("/", relative.relative_path())) return *found;
    return Fail(ErrorCode::kNotFound, "cannot find " + path);
  }
  const fs::path here = naming_file.parent_path();
  const fs::path from_parent = here.lexically_normal().filename() / relative;
  if (!here.empty() && ClimbsOut(relative) && ClimbsOut(from_parent)) {
    return Fail(ErrorCode::kNotFound, path + " is outside the model folders");
  }
  if (auto found = FindBelow(here.empty() ? fs::path(".") : here, relative)) return *found;
  if (!ClimbsOut(relative)) {
    for (const fs::path& folder : FoldersFor(naming_file)) {
      if (auto found = FindBelow(folder, relative)) return *found;
    }
  }
  return Fail(ErrorCode::kNotFound,
              "cannot find " + path + " beside the file or on the model path");
}

std::vector<fs::path> ResourceFinder::FoldersFor(const fs::path& naming_file) const {
  std::vector<fs::path> folders;
  std::error_code ignored;
  fs::path folder = naming_file.empty() ? fs::current_path(ignored)
                                        : fs::absolute(naming_file, ignored).parent_path();
  folder = folder.lexically_normal();
  for (int level = 0; level <= kParentsSearched && folder.has_relative_path(); ++level) {
    folders.push_back(folder);
    folders.push_back(folder / "models");
    folder = folder.parent_path();
  }
  folders.insert(folders.end(), search_path_.begin(), search_path_.end());
  return folders;
}

base::Result<fs::path> ModelFileIn(const fs::path& folder) {
  constexpr int kNewest = 109;
  constexpr int kOldest = 103;
  fs::path best = folder / "model.sdf";
  tinyxml2::XMLDocument config;
  if (config.LoadFile((folder / "model.config").c_str()) == tinyxml2::XML_SUCCESS &&
      config.RootElement() != nullptr) {
    int best_version = 0;
    for (auto* sdf = config.RootElement()->FirstChildElement("sdf"); sdf != nullptr;
         sdf = sdf->NextSiblingElement("sdf")) {
      const char* name = sdf->GetText();
      const int version = VersionNumber(sdf->Attribute("version"));
      if (name == nullptr || ClimbsOut(name) || version < kOldest) continue;
      // A file of a version newer than kNewest is used only if there is no file of an accepted
      // version.
      const int rank = version <= kNewest ? version : 1;
      if (rank > best_version && Exists(folder / name)) {
        best_version = rank;
        best = folder / name;
      }
    }
  }
  if (!Exists(best)) {
    return Fail(ErrorCode::kBadModel,
                "the folder contains no model.sdf, and no model.config that names an SDFormat file",
                folder.string());
  }
  return best;
}

}  // namespace gsv::formats
