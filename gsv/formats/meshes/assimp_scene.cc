#include "gsv/formats/meshes/assimp_scene.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/IOSystem.hpp>

#include "gsv/formats/meshes/collada_check.h"
#include "gsv/formats/meshes/collada_repair.h"
#include "gsv/formats/meshes/gltf_check.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using base::ErrorCode;

std::string LowerExtension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// assimp refuses COLLADA files with blanks at the start of a <color>. This moves the blanks into
// the tag, where they have no effect. All offsets stay the same.
void MoveBlanksOutOfColours(std::string& text) {
  for (std::size_t tag = text.find("<color"); tag != std::string::npos;
       tag = text.find("<color", tag + 1)) {
    const std::size_t end = text.find('>', tag);
    if (end == std::string::npos) return;
    std::size_t first = end + 1;
    while (first < text.size() && std::isspace(static_cast<unsigned char>(text[first]))) ++first;
    if (first == end + 1 || text[end - 1] == '/') continue;
    std::fill(text.begin() + static_cast<std::ptrdiff_t>(end),
              text.begin() + static_cast<std::ptrdiff_t>(first - 1), ' ');
    text[first - 1] = '>';
  }
}

// A file beside a mesh. It replaces assimp's own stream classes, because these are not available if
// assimp is loaded on demand.
class FileStream final : public Assimp::IOStream {
 public:
  static FileStream* Open(const char* name) {
    std::FILE* file = std::fopen(name, "rb");
    return file == nullptr ? nullptr : new FileStream(file);
  }
  ~FileStream() override { std::fclose(file_); }

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    return std::fread(to, size, count, file_);
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const int from = origin == aiOrigin_SET   ? SEEK_SET
                     : origin == aiOrigin_CUR ? SEEK_CUR
                                              : SEEK_END;
    const int status = std::fseek(file_, static_cast<long>(offset), from);
    return status == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
  }
  std::size_t Tell() const override { return static_cast<std::size_t>(std::ftell(file_)); }
  std::size_t FileSize() const override {
    const long here = std::ftell(file_);
    std::fseek(file_, 0, SEEK_END);
    const long size = std::ftell(file_);
    std::fseek(file_, here, SEEK_SET);
    return size < 0 ? 0 : static_cast<std::size_t>(size);
  }
  void Flush() override {}

 private:
  explicit FileStream(std::FILE* file) : file_(file) {}

  std::FILE* const file_;
};

// Reads the mesh from memory, and other files only from the mesh's folder and its parent folder.
class MeshFolder final : public Assimp::IOSystem {
 public:
  MeshFolder(fs::path file, std::string text)
      : file_(std::move(file)), text_(std::move(text)), root_(file_.parent_path().parent_path()) {}

  bool Exists(const char* name) const override {
    return IsMesh(name) || (IsInside(name) && IsFile(name));
  }
  char getOsSeparator() const override { return '/'; }

  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (IsMesh(name)) {
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text_.data()),
                                        text_.size(), false);
    }
    const bool reads = std::strchr(mode, 'w') == nullptr && std::strchr(mode, 'a') == nullptr;
    return reads && IsInside(name) && IsFile(name) ? FileStream::Open(name) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  bool IsMesh(const char* name) const { return fs::path(name).lexically_normal() == file_; }
  static bool IsFile(const char* name) {
    std::error_code ignored;
    return fs::is_regular_file(name, ignored);
  }
  bool IsInside(const char* name) const {
    std::error_code ignored;
    const fs::path path = fs::absolute(name, ignored).lexically_normal();
    const fs::path below = path.lexically_relative(root_);
    return !below.empty() && *below.begin() != "..";
  }

  fs::path file_;
  std::string text_;
  fs::path root_;
};

void KeepOnlyNamedImporters(Assimp::Importer& importer) {
  static const std::set<std::string> kept = {"Collada Importer", "Wavefront Object Importer",
                                             "Stereolithography (STL) Importer", "glTF2 Importer"};
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* candidate = importer.GetImporter(i);
    if (kept.count(candidate->GetInfo()->mName) != 0) continue;
    importer.UnregisterLoader(candidate);
    delete candidate;
  }
}

base::Result<std::string> ReadBytes(const fs::path& path, std::size_t limit) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error) return Fail(ErrorCode::kNotFound, "the mesh cannot be read", path.string());
  if (size > limit) {
    return Fail(ErrorCode::kBadModel,
                "the mesh is larger than the limit of " + std::to_string(limit) + " bytes",
                path.string());
  }
  std::ifstream file(path, std::ios::binary);
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

// Corrects the number of triangles in the header of a binary STL, if the file has fewer. A triangle
// has 50 bytes.
void CountTriangles(std::string& stl, std::vector<std::string>& changes) {
  constexpr std::size_t kHeader = 84, kTriangle = 50, kCount = 80;
  if (stl.size() < kHeader || stl.compare(0, 5, "solid") == 0) return;
  std::uint32_t claimed = 0;
  std::memcpy(&claimed, stl.data() + kCount, sizeof claimed);
  const std::size_t held = (stl.size() - kHeader) / kTriangle;
  if (held >= claimed) return;
  changes.push_back("its header declares more triangles than the file contains; " +
                    std::to_string(held) + " of " + std::to_string(claimed) + " are read");
  const auto count = static_cast<std::uint32_t>(held);
  std::memcpy(stl.data() + kCount, &count, sizeof count);
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

// Reads `bytes` as the file. Returns the reason if that fails; the scene is null then.
std::string Import(const fs::path& path, const std::string& bytes, AssimpScene& result) {
  result.importer = std::make_unique<Assimp::Importer>();
  KeepOnlyNamedImporters(*result.importer);
  result.importer->SetIOHandler(new MeshFolder(path, bytes));
  result.importer->SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  result.importer->SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  result.importer->SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                      aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  try {
    result.scene = result.importer->ReadFile(
        path.string(), aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GenNormals |
                           aiProcess_JoinIdenticalVertices);
  } catch (const std::exception& exception) {
    result.scene = nullptr;
    return FirstLine(exception.what());
  }
  if (result.scene != nullptr && result.scene->mRootNode != nullptr) return "";
  result.scene = nullptr;
  return FirstLine(result.importer->GetErrorString());
}

// Replaces numbers such as ".2" and "-.2" by "0.2" and "-0.2", because assimp's OBJ reader does not
// read numbers that begin with a point. Leaves lines other than vertices, normals and texture
// coordinates as they are.
void WriteLeadingZeros(std::string& bytes) {
  if (bytes.find(" .") == std::string::npos && bytes.find("-.") == std::string::npos) return;
  std::string repaired;
  repaired.reserve(bytes.size() + bytes.size() / 8);
  bool is_vertex = false, is_line_start = true;
  char before = '\n';
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = bytes[i];
    if (is_line_start) is_vertex = c == 'v';
    const bool follows = before == ' ' || before == '\t' || before == '-' || before == '+';
    const bool precedes = i + 1 < bytes.size() && bytes[i + 1] >= '0' && bytes[i + 1] <= '9';
    if (is_vertex && c == '.' && follows && precedes) repaired += '0';
    repaired += c;
    is_line_start = c == '\n';
    before = c;
  }
  bytes = std::move(repaired);
}

}  // namespace

base::Result<AssimpScene> OpenScene(const fs::path& given, const ReadLimits& limits) {
  std::error_code ignored;
  const fs::path path = fs::absolute(given, ignored).lexically_normal();
  const std::string extension = LowerExtension(path);
  static const std::set<std::string> known = {".dae", ".obj", ".stl", ".gltf", ".glb"};
  if (known.count(extension) == 0) {
    return Fail(ErrorCode::kBadModel,
                "meshes are read from .dae, .obj, .stl, .gltf and .glb files only", path.string());
  }
  auto bytes = ReadBytes(path, limits.mesh_bytes);
  if (!bytes) return Fail(bytes.error());
  AssimpScene result;
  if (extension == ".dae") {
    ColladaRepair repair = RepairCollada(*bytes);
    result.changes = std::move(repair.changes);
    result.ids_of = std::move(repair.ids_of);
    if (auto status = CheckCollada(*bytes, path.string()); !status) return Fail(status.error());
    MoveBlanksOutOfColours(*bytes);
  }
  if (extension == ".gltf" || extension == ".glb") {
    const auto status = CheckGltf(*bytes, extension == ".glb", limits, path.string());
    if (!status) return Fail(status.error());
  }
  // assimp's OBJ reader reads beyond a last line without a newline.
  if (extension == ".obj") {
    *bytes += '\n';
    WriteLeadingZeros(*bytes);
  }
  if (extension == ".stl") CountTriangles(*bytes, result.changes);
  std::string reason = Import(path, *bytes, result);
  static constexpr const char* kSimplified[] = {"its animations, cameras and lights",
                                                "its materials"};
  for (int level = 1; level <= 2 && result.scene == nullptr && extension == ".dae"; ++level) {
    if (!SimplifyCollada(*bytes, level)) continue;
    const std::string again = Import(path, *bytes, result);
    if (result.scene != nullptr) {
      result.changes.push_back("it is read without " + std::string(kSimplified[level - 1]) +
                               ", which cannot be read (" + reason + ")");
    }
    reason = again;
  }
  if (result.scene == nullptr) {
    return Fail(ErrorCode::kBadModel,
                "the mesh cannot be read" + (reason.empty() ? "" : " (" + reason + ")"),
                path.string());
  }
  return result;
}

}  // namespace gsv::formats
