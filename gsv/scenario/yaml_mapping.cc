#include "gsv/scenario/yaml_mapping.h"

#include <charconv>
#include <cstdio>

#include "gsv/base/spelling.h"
#include "gsv/scenario/scenario.h"

namespace gsv::scenario {
namespace {

constexpr std::size_t kMaxQuoteLength = 80;

std::string Quoted(const std::string& text) {
  return "\"" + text.substr(0, kMaxQuoteLength) + (text.size() > kMaxQuoteLength ? "…" : "") + "\"";
}

std::string KindOf(const YAML::Node& node) {
  switch (node.Type()) {
    case YAML::NodeType::Sequence:
      return "a list";
    case YAML::NodeType::Map:
      return "a mapping";
    case YAML::NodeType::Scalar:
      return Quoted(node.Scalar());
    default:
      return "nothing";
  }
}

std::string Short(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

}  // namespace

std::string YamlPlace::Of(const YAML::Mark& mark, const std::string& field) const {
  if (naming_ == Naming::kFields) return field;
  if (mark.is_null()) return file_;
  return file_ + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
}

void YamlPlace::AddProblem(const YAML::Mark& mark, const std::string& field,
                           std::string message) const {
  if (problems_.size() >= kMaxProblems) return;
  problems_.push_back({base::Problem::Severity::kError, std::move(message), Of(mark, field)});
}

YamlMapping::YamlMapping(const YAML::Node& node, std::string field, const YamlPlace& place)
    : place_(place), field_(std::move(field)), mark_(node.Mark()), is_mapping_(node.IsMap()) {
  if (!is_mapping_) {
    AddProblem("expected a mapping (key: value), found " + KindOf(node));
    return;
  }
  if (node.size() > kMaxKeys) {
    AddProblem("a mapping has at most 64 keys here");
    return;
  }
  for (const auto& entry : node) {
    const YAML::Mark mark = entry.first.Mark();
    if (!entry.first.IsScalar()) {
      place_.AddProblem(mark, field_, "a key must be a word, found " + KindOf(entry.first));
      continue;
    }
    const std::string& key = entry.first.Scalar();
    const bool is_new = unread_.try_emplace(key, Entry{mark, entry.second}).second;
    if (!is_new) place_.AddProblem(mark, FieldOf(key), "the key " + Quoted(key) + " occurs twice");
  }
}

YamlMapping::~YamlMapping() {
  if (unread_.empty()) return;
  std::string known;
  for (const std::string& key : known_) known += (known.empty() ? "" : ", ") + key;
  for (const auto& [key, entry] : unread_) {
    place_.AddProblem(entry.mark, FieldOf(key.substr(0, kMaxQuoteLength)),
                      "there is no key " + Quoted(key) + " here; the known keys are " + known +
                          base::DidYouMean(key, known_));
  }
}

std::optional<YAML::Node> YamlMapping::Any(const std::string& key) {
  known_.push_back(key);
  const auto entry = unread_.extract(key);
  if (entry.empty() || entry.mapped().value.IsNull()) return std::nullopt;
  marks_[key] = entry.mapped().value.Mark();
  return entry.mapped().value;
}

void YamlMapping::Expect(const std::string& key, const std::string& expected,
                         const std::string& found) {
  AddProblem(key, key + " must be " + expected + ", found " + found);
}

void YamlMapping::AddProblem(const std::string& key, std::string message) const {
  const auto mark = marks_.find(key);
  place_.AddProblem(mark == marks_.end() ? mark_ : mark->second, FieldOf(key), std::move(message));
}

std::optional<std::string> YamlMapping::Scalar(const std::string& key,
                                               const std::string& expected) {
  const auto node = Any(key);
  if (!node) return std::nullopt;
  if (node->IsScalar()) return node->Scalar();
  Expect(key, expected, KindOf(*node));
  return std::nullopt;
}

std::optional<std::string> YamlMapping::Plain(const std::string& key, const std::string& expected) {
  const auto node = Any(key);
  if (!node) return std::nullopt;
  const bool is_quoted = node->IsScalar() && node->Tag() == "!";
  if (node->IsScalar() && !is_quoted) return node->Scalar();
  Expect(key, expected, is_quoted ? "the text " + KindOf(*node) : KindOf(*node));
  return std::nullopt;
}

std::optional<std::string> YamlMapping::Text(const std::string& key) {
  return Scalar(key, "a text");
}

std::optional<double> YamlMapping::Number(const std::string& key, double least, double most) {
  const std::string expected = "a number from " + Short(least) + " to " + Short(most);
  const auto text = Plain(key, expected);
  if (!text) return std::nullopt;
  const auto number = ParseNumber(*text);
  if (number && *number >= least && *number <= most) return number;
  Expect(key, expected, Quoted(*text));
  return std::nullopt;
}

std::optional<double> YamlMapping::Angle(const std::string& key) {
  const std::string expected = "an angle in radians, or as 90deg";
  const auto text = Scalar(key, expected);
  if (!text) return std::nullopt;
  const auto angle = ParseAngle(*text);
  if (!angle) Expect(key, expected, Quoted(*text));
  return angle;
}

std::optional<std::uint64_t> YamlMapping::Count(const std::string& key) {
  const std::string expected = "a whole number from 0 to 18446744073709551615";
  const auto text = Plain(key, expected);
  if (!text) return std::nullopt;
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), count);
  if (error == std::errc() && end == text->data() + text->size()) return count;
  Expect(key, expected, Quoted(*text));
  return std::nullopt;
}

std::optional<bool> YamlMapping::Flag(const std::string& key) {
  const std::string expected = "false or true";
  const auto text = Plain(key, expected);
  if (!text) return std::nullopt;
  if (*text == "false" || *text == "true") return *text == "true";
  Expect(key, expected, Quoted(*text));
  return std::nullopt;
}

std::optional<bool> YamlMapping::IsSecondOf(const std::string& key, const std::string& first,
                                            const std::string& second) {
  const std::string expected = first + " or " + second;
  const auto text = Scalar(key, expected);
  if (!text) return std::nullopt;
  if (*text == first || *text == second) return *text == second;
  Expect(key, expected, Quoted(*text));
  return std::nullopt;
}

std::vector<YAML::Node> YamlMapping::List(const std::string& key) {
  const auto node = Any(key);
  if (!node) return {};
  if (node->IsSequence()) return {node->begin(), node->end()};
  Expect(key, "a list", KindOf(*node));
  return {};
}

std::vector<std::string> YamlMapping::Texts(const std::string& key) {
  std::vector<std::string> texts;
  for (const YAML::Node& node : List(key)) {
    if (node.IsScalar()) {
      texts.push_back(node.Scalar());
    } else {
      place_.AddProblem(node.Mark(), FieldOf(key),
                        key + " must be a list of texts, found " + KindOf(node));
    }
  }
  return texts;
}

}  // namespace gsv::scenario
