#include "gsv/formats/xacro/yaml_values.h"

#include <fstream>
#include <iterator>
#include <numbers>
#include <system_error>

#include <yaml-cpp/yaml.h>

#include "gsv/base/named.h"

namespace gsv::formats::xacro {
namespace {

constexpr int kMaxYamlDepth = 32;
constexpr std::size_t kMaxYamlNodes = 20'000;

// The units of xacro's YAML tags, in SI units.
constexpr base::Named<double> kUnits[] = {
    {"!degrees", std::numbers::pi / 180},
    {"!radians", 1},
    {"!meters", 1},
    {"!millimeters", 0.001},
    {"!inches", 0.0254},
    {"!foot", 0.3048},
};

class YamlReader {
 public:
  explicit YamlReader(const std::filesystem::path& file) : file_(file) {}

  base::Result<Value> Read(const YAML::Node& node, int depth) {
    if (depth > kMaxYamlDepth) {
      return Refuse("the YAML is nested deeper than " + std::to_string(kMaxYamlDepth) + " levels",
                    node.Mark());
    }
    if (++nodes_ > kMaxYamlNodes) {
      return Refuse("the YAML has more than " + std::to_string(kMaxYamlNodes) + " values",
                    node.Mark());
    }
    if (node.IsSequence()) {
      List items;
      for (const auto& each : node) {
        auto item = Read(each, depth + 1);
        if (!item) return item;
        items.push_back(*std::move(item));
      }
      return MakeList(std::move(items));
    }
    if (node.IsMap()) return Mapping(node, depth);
    return node.IsScalar() ? Scalar(node) : Value{};
  }

  base::Failure<base::Error> Refuse(const std::string& why, const YAML::Mark& mark) const {
    return base::Fail(base::ErrorCode::kBadModel, why,
                      file_.string() + ":" + std::to_string(mark.line + 1));
  }

 private:
  base::Result<Value> Mapping(const YAML::Node& node, int depth) {
    Dictionary entries;
    for (const auto& each : node) {
      auto key = Read(each.first, depth + 1);
      if (!key) return key;
      auto value = Read(each.second, depth + 1);
      if (!value) return value;
      entries.emplace_back(*std::move(key), *std::move(value));
    }
    return MakeDictionary(std::move(entries));
  }

  base::Result<Value> Scalar(const YAML::Node& node) const {
    const std::string& text = node.Scalar();
    const std::string& tag = node.Tag();
    if (const double* unit = base::FindNamed(kUnits, tag)) {
      const auto number = ParseFloat(text);
      if (!number) return Refuse(tag + " takes a number, not \"" + text + "\"", node.Mark());
      return Value{*number * *unit};
    }
    if (tag == "!") return Value{text};  // in quotes
    if (text == "null" || text == "~" || text.empty()) return Value{};
    for (const char* word : {"true", "True", "yes", "on"}) {
      if (text == word) return Value{true};
    }
    for (const char* word : {"false", "False", "no", "off"}) {
      if (text == word) return Value{false};
    }
    if (const auto number = ParseInteger(text)) return Value{*number};
    if (const auto number = ParseFloat(text)) return Value{*number};
    return Value{text};
  }

  const std::filesystem::path& file_;
  std::size_t nodes_ = 0;
};

}  // namespace

base::Result<Value> LoadYaml(const std::filesystem::path& file, std::size_t max_bytes) {
  const auto refuse = [&](const std::string& why) {
    return base::Fail(base::ErrorCode::kBadModel, why, file.string());
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return refuse("there is no such file");
  const auto size = std::filesystem::file_size(file, error);
  if (error) return refuse("the file cannot be read: " + error.message());
  if (size > max_bytes) {
    return refuse("the file is larger than the limit of " + std::to_string(max_bytes) + " bytes");
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  YamlReader reader(file);
  try {
    return reader.Read(YAML::Load(text), 0);
  } catch (const YAML::Exception& exception) {
    return reader.Refuse("this is not valid YAML: " + exception.msg, exception.mark);
  }
}

}  // namespace gsv::formats::xacro
