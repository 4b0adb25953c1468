#include "gsv/messages/definition.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <sstream>

#include <nlohmann/json.hpp>

#include "gsv/base/cdr_reader.h"
#include "gsv/base/named.h"

namespace gsv::messages {
namespace {

using nlohmann::ordered_json;

constexpr int kMaxNesting = 16;                // maximum nesting of structs
constexpr std::size_t kMaxTypes = 500;         // maximum number of types in a schema
constexpr std::size_t kMaxFields = 1000;       // maximum number of fields of a type
constexpr std::size_t kMaxValues = 4'000'000;  // maximum number of values in a message

base::Failure<base::Error> Bad(std::string message, std::string_view where) {
  return base::Fail(base::ErrorCode::kCorrupt, std::move(message), std::string(where));
}

// "sensor_msgs/msg/Range" and "sensor_msgs/Range" are the same type.
std::string PlainName(std::string_view name) {
  std::string plain(name);
  if (const std::size_t at = plain.find("/msg/"); at != std::string::npos) plain.erase(at, 4);
  return plain;
}

std::string PackageOf(const std::string& type) { return type.substr(0, type.find('/')); }

std::vector<std::string> Words(std::string_view line) {
  std::istringstream stream{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(std::move(word));
  return words;
}

// Returns the number if the whole text is a number.
std::optional<std::size_t> Number(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

base::Result<Definition> Definition::Parse(std::string_view name, std::string_view text) {
  Definition definition;
  definition.root_ = PlainName(name);
  std::string type = definition.root_;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    // A line of '=' and a line with the name of the next type separate two types.
    std::size_t end = text.find("\n====", begin);
    if (end == std::string_view::npos) end = text.size();
    if (auto ok = definition.AddStruct(type, text.substr(begin, end - begin)); !ok) {
      return base::Fail(ok.error());
    }
    const std::size_t named = text.find("MSG: ", end);
    if (end == text.size() || named == std::string_view::npos) break;
    std::size_t line_end = text.find('\n', named);
    if (line_end == std::string_view::npos) line_end = text.size();
    const std::vector<std::string> words = Words(text.substr(named + 5, line_end - named - 5));
    if (words.empty()) return Bad("a type has no name", name);
    type = PlainName(words.front());
    begin = line_end;
  }
  if (auto ok = definition.Check(); !ok) return base::Fail(ok.error());
  return definition;
}

base::Status Definition::AddStruct(const std::string& type, std::string_view text) {
  static constexpr base::Named<std::pair<Kind, std::size_t>> kNumbers[] = {
      {"bool", {Kind::kBool, 1}},       {"byte", {Kind::kUnsigned, 1}},
      {"char", {Kind::kUnsigned, 1}},   {"int8", {Kind::kInteger, 1}},
      {"uint8", {Kind::kUnsigned, 1}},  {"int16", {Kind::kInteger, 2}},
      {"uint16", {Kind::kUnsigned, 2}}, {"int32", {Kind::kInteger, 4}},
      {"uint32", {Kind::kUnsigned, 4}}, {"int64", {Kind::kInteger, 8}},
      {"uint64", {Kind::kUnsigned, 8}}, {"float32", {Kind::kFloat, 4}},
      {"float64", {Kind::kFloat, 8}}};
  if (structs_.size() >= kMaxTypes) return Bad("too many types", root_);
  Struct& fields = structs_[type];
  fields.clear();
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> words = Words(line.substr(0, line.find('#')));
    if (words.size() < 2) continue;
    // NAME=value and NAME = value are constants; a default follows the name after a blank.
    if (words[1].find('=') != std::string::npos) continue;
    if (words.size() > 2 && words[2].front() == '=') continue;
    if (fields.size() >= kMaxFields) return Bad("too many fields", type);
    Field field;
    field.name = words[1];
    std::string base = words[0];
    if (const std::size_t bracket = base.find('['); bracket != std::string::npos) {
      const std::string inside = base.substr(bracket + 1, base.find(']') - bracket - 1);
      const auto length = Number(inside);
      field.shape = length ? Shape::kArray : Shape::kSequence;
      field.length = length.value_or(0);
      base.resize(bracket);
    }
    base.resize(std::min(base.size(), base.find('<')));  // string<=N
    if (const auto* number = base::FindNamed(kNumbers, base)) {
      field.kind = number->first;
      field.size = number->second;
    } else if (base == "string" || base == "wstring") {
      if (base == "wstring")
        return Bad("wide strings (wstring) are not supported", type + "." + field.name);
      field.kind = Kind::kString;
    } else {
      field.kind = Kind::kStruct;
      field.struct_type = base == "Header"                      ? "std_msgs/Header"
                          : base.find('/') == std::string::npos ? PackageOf(type) + "/" + base
                                                                : PlainName(base);
    }
    fields.push_back(std::move(field));
  }
  return {};
}

base::Status Definition::Check() const {
  // A type that contains itself would be infinite, so the nesting of structs is limited.
  std::vector<std::pair<std::string, int>> open{{root_, 0}};
  std::map<std::string, int> deepest;
  while (!open.empty()) {
    const auto [type, depth] = open.back();
    open.pop_back();
    const auto found = structs_.find(type);
    if (found == structs_.end()) return Bad("the schema lacks the type " + type, root_);
    if (depth > kMaxNesting) return Bad("types are nested too deep", root_);
    const auto known = deepest.find(type);
    if (known != deepest.end() && known->second >= depth) continue;
    deepest[type] = depth;
    for (const Field& field : found->second) {
      if (field.kind == Kind::kStruct) open.emplace_back(field.struct_type, depth + 1);
    }
  }
  return {};
}

// Decodes the bytes of one message to JSON.
class Decoder {
 public:
  Decoder(const Definition& definition, std::span<const std::byte> cdr)
      : definition_(definition),
        in_({reinterpret_cast<const char*>(cdr.data()) + 4, cdr.size() - 4},
            cdr[1] == std::byte{1}) {}

  // Reads a struct. Returns false if the bytes do not fit its type.
  bool Read(const std::string& type, ordered_json& out) {
    out = ordered_json::object();
    for (const Definition::Field& field : definition_.structs_.at(type)) {
      if (!ReadField(field, out[field.name])) return false;
    }
    return true;
  }

 private:
  using Kind = Definition::Kind;
  using Shape = Definition::Shape;

  bool ReadField(const Definition::Field& field, ordered_json& out) {
    if (field.shape == Shape::kSingle) return ReadOne(field, out);
    const std::size_t count = field.shape == Shape::kSequence ? in_.ULong() : field.length;
    // Empty structs also count as values, so that their number is limited.
    if (!in_.ok() || count > kMaxValues || values_ + count > kMaxValues) return false;
    if (field.kind == Kind::kUnsigned && field.size == 1) {
      out = {{"bytes", count}};
      in_.Skip(count);
      return in_.ok();
    }
    out = ordered_json::array();
    for (std::size_t i = 0; i < count; ++i) {
      out.emplace_back();
      if (!ReadOne(field, out.back())) return false;
    }
    return true;
  }

  bool ReadOne(const Definition::Field& field, ordered_json& out) {
    if (++values_ > kMaxValues) return false;
    switch (field.kind) {
      case Kind::kStruct:
        return Read(field.struct_type, out);
      case Kind::kString:
        return ReadString(out);
      case Kind::kFloat:
        return field.size == 4 ? Store<float>(out) : Store<double>(out);
      case Kind::kInteger:
        return StoreInteger<std::int8_t, std::int16_t, std::int32_t, std::int64_t>(field.size, out);
      case Kind::kUnsigned:
        return StoreInteger<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t>(field.size,
                                                                                       out);
      case Kind::kBool:
        out = in_.Octet() != 0;
        return in_.ok();
    }
    return false;
  }

  template <typename Byte, typename Short, typename Long, typename LongLong>
  bool StoreInteger(std::size_t size, ordered_json& out) {
    if (size == 1) return Store<Byte>(out);
    if (size == 2) return Store<Short>(out);
    return size == 4 ? Store<Long>(out) : Store<LongLong>(out);
  }

  template <typename Value>
  bool Store(ordered_json& out) {
    out = in_.Number<Value>();
    return in_.ok();
  }

  bool ReadString(ordered_json& out) {
    std::string_view text = in_.Octets();
    text.remove_suffix(text.empty() ? 0 : 1);  // removes the terminating zero
    out = std::string(text);
    return in_.ok();
  }

  const Definition& definition_;
  base::CdrReader in_;  // starts after the encapsulation header
  std::size_t values_ = 0;
};

base::Result<ordered_json> Definition::Decode(std::span<const std::byte> cdr) const {
  // Identifiers 0 and 1 are plain CDR, big and little endian.
  if (cdr.size() < 4 || cdr[0] != std::byte{0} || cdr[1] > std::byte{1}) {
    return Bad("the message is not plain CDR", root_);
  }
  ordered_json message;
  if (!Decoder(*this, cdr).Read(root_, message)) {
    return Bad("the message does not fit its schema", root_);
  }
  return message;
}

}  // namespace gsv::messages
