#include "gsv/formats/meshes/gltf_check.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace gsv::formats {
namespace {

using base::ErrorCode;

// Maximum nesting of the JSON. glTF itself has about ten levels, but "extras" may have more.
constexpr int kMaxJsonDepth = 64;
// assimp visits nodes recursively, so deeper nodes could exhaust the stack.
constexpr std::size_t kMaxNodeDepth = 512;
// Maximum number of nodes. A node with several paths from a root counts once for each path, because
// assimp copies it.
constexpr std::size_t kMaxNodes = 1'000'000;

std::uint32_t WordAt(std::string_view bytes, std::size_t place) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + place, sizeof word);
  return word;
}

// Returns the JSON of a .glb; nullopt if one of the two chunks that assimp reads reaches beyond the
// end.
std::optional<std::string_view> JsonOf(std::string_view glb) {
  constexpr std::size_t kFileHeader = 12, kChunkHeader = 8;
  if (glb.size() < kFileHeader + kChunkHeader) return std::nullopt;
  const std::string_view chunks = glb.substr(kFileHeader);
  const std::size_t length = WordAt(chunks, 0);
  if (length > chunks.size() - kChunkHeader) return std::nullopt;
  const std::string_view json = chunks.substr(kChunkHeader, length);
  // A chunk begins at a multiple of four bytes.
  const std::size_t end = std::min(kChunkHeader + (length + 3) / 4 * 4, chunks.size());
  const std::string_view second = chunks.substr(end);
  if (second.size() >= kChunkHeader && WordAt(second, 0) > second.size() - kChunkHeader) {
    return std::nullopt;
  }
  return json;
}

// For each node, the indices of its child nodes.
using Children = std::vector<std::vector<std::size_t>>;

// Returns why assimp must not read nodes with these children, or null.
const char* FaultOf(const Children& children) {
  struct Node {
    std::size_t parents = 0;  // parents that have not been visited yet
    std::size_t depth = 0;
    std::size_t copies = 0;  // number of paths from a root
  };
  std::vector<Node> nodes(children.size());
  for (const auto& each : children) {
    for (const std::size_t child : each) {
      if (child >= nodes.size()) return "the mesh cannot be read: a node names a missing child";
      ++nodes[child].parents;
    }
  }
  std::vector<std::size_t> order;  // each node after all its parents
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parents != 0) continue;
    order.push_back(i);
    nodes[i].copies = 1;
  }
  std::size_t copies = 0;
  for (std::size_t next = 0; next < order.size(); ++next) {
    const Node node = nodes[order[next]];
    copies += node.copies;
    if (copies > kMaxNodes) return "the mesh has more than 1000000 nodes";
    if (node.depth > kMaxNodeDepth)
      return "the mesh cannot be read: its nodes are nested deeper than 512 levels";
    for (const std::size_t child : children[order[next]]) {
      nodes[child].depth = std::max(nodes[child].depth, node.depth + 1);
      nodes[child].copies = std::min(nodes[child].copies + node.copies, kMaxNodes + 1);
      if (--nodes[child].parents == 0) order.push_back(child);
    }
  }
  return order.size() == nodes.size() ? nullptr : "the mesh cannot be read: a node contains itself";
}

// Checks the sizes and counts that the JSON declares. It receives the values one by one while they
// are parsed, and stores only the children of nodes.
class DeclaredSizeChecker : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit DeclaredSizeChecker(const ReadLimits& limits)
      : max_bytes_(limits.mesh_bytes),
        max_values_(std::max(limits.mesh_vertices, 3 * limits.mesh_triangles)) {}

  bool key(string_t& name) override {
    if (depth_ == kInRoot) {
      is_nodes_ = name == "nodes";
      claims_ = name == "buffers" || name == "bufferViews" || name == "accessors";
    }
    if (depth_ == kInElement) {
      is_sparse_ = name == "sparse";
      is_children_ = is_nodes_ && name == "children";
    }
    // The names below declare sizes only in the elements of accessors, buffers and buffer views. In
    // other places, and in "extras", they have another meaning.
    if (!claims_ || !(depth_ == kInElement || (depth_ > kInElement && is_sparse_))) return true;
    if (name == "byteLength" || name == "byteOffset" || name == "byteStride")
      max_number_ = max_bytes_;
    if (name == "count") max_number_ = max_values_;
    return true;
  }
  bool number_unsigned(number_unsigned_t value) override {
    if (is_children_ && depth_ == kInElement + 1) children_.back().push_back(value);
    return Take(value <= max_number_);
  }
  bool number_integer(number_integer_t) override {
    return Take(max_number_ == kNoSizeLimit);
  }  // negative
  bool number_float(number_float_t, const string_t&) override {
    return Take(max_number_ == kNoSizeLimit);
  }
  bool null() override { return Take(true); }
  bool boolean(bool) override { return Take(true); }
  bool string(string_t&) override { return Take(true); }
  bool binary(binary_t&) override { return Take(true); }
  bool start_object(std::size_t) override { return Enter(); }
  bool end_object() override { return Leave(); }
  bool start_array(std::size_t) override { return Enter(); }
  bool end_array() override { return Leave(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    wrong = "the mesh cannot be read: its JSON is malformed";
    return false;
  }

  const Children& children() const { return children_; }

  const char* wrong = nullptr;

 private:
  static constexpr std::size_t kNoSizeLimit = SIZE_MAX;
  // Nesting depths of a key: in the root object, and in an object of one of the root's arrays.
  static constexpr int kInRoot = 1, kInElement = 3;

  bool Take(bool is_allowed) {
    if (!is_allowed)
      wrong =
          "the mesh declares more bytes or values than the limits mesh_bytes, mesh_vertices and "
          "mesh_triangles allow";
    max_number_ = kNoSizeLimit;
    return is_allowed;
  }
  bool Enter() {
    if (++depth_ > kMaxJsonDepth)
      wrong = "the mesh cannot be read: its JSON is nested deeper than 64 levels";
    if (is_nodes_ && depth_ == kInElement) children_.emplace_back();
    return Take(true) && wrong == nullptr;
  }
  bool Leave() {
    if (--depth_ == kInElement) is_children_ = false;
    return true;
  }

  const std::size_t max_bytes_, max_values_;
  std::size_t max_number_ = kNoSizeLimit;  // limit of the next number
  int depth_ = 0;
  // Whether the parser is in an array whose elements declare sizes, and in a "sparse" object.
  bool claims_ = false, is_sparse_ = false;
  bool is_nodes_ = false, is_children_ = false;
  Children children_;
};

}  // namespace

base::Status CheckGltf(const std::string& bytes, bool is_binary, const ReadLimits& limits,
                       const std::string& file) {
  std::string_view json = bytes;
  if (is_binary) {
    if (!json.starts_with("glTF")) {
      return Fail(ErrorCode::kBadModel,
                  "the mesh cannot be read: a .glb file must begin with the bytes \"glTF\"", file);
    }
    const std::optional<std::string_view> chunk = JsonOf(bytes);
    if (!chunk) {
      return Fail(ErrorCode::kBadModel,
                  "the mesh's header declares more bytes than the file contains", file);
    }
    json = *chunk;
  }
  // Some writers pad the JSON with zeros. assimp's reader stops at the first zero, so this check
  // stops there, too.
  json = json.substr(0, json.find('\0'));
  DeclaredSizeChecker checker(limits);
  nlohmann::json::sax_parse(json, &checker);
  if (checker.wrong == nullptr) checker.wrong = FaultOf(checker.children());
  if (checker.wrong == nullptr) return {};
  return Fail(ErrorCode::kBadModel, checker.wrong, file);
}

}  // namespace gsv::formats
