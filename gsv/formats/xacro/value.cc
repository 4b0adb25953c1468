#include "gsv/formats/xacro/value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace gsv::formats::xacro {
namespace {

constexpr int kMaxTextDepth = 32;  // maximum nesting of lists in a text

std::string Trimmed(const std::string& text) {
  constexpr const char* kBlanks = " \t\n\r\f\v";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string LowerCased(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string Quoted(const std::string& text) {
  const char quote =
      text.find('\'') != std::string::npos && text.find('"') == std::string::npos ? '"' : '\'';
  std::string quoted(1, quote);
  for (const char c : text) {
    if (c == quote || c == '\\') quoted += '\\';
    if (c == '\n') {
      quoted += "\\n";
    } else {
      quoted += c;
    }
  }
  return quoted + quote;
}

std::string Printed(const Value& value, bool quotes, int depth);

std::string PrintedItems(const List& items, int depth) {
  std::string text;
  for (const Value& item : items) {
    text += (text.empty() ? "" : ", ") + Printed(item, true, depth - 1);
  }
  return text;
}

std::string PrintedEntries(const Dictionary& entries, int depth) {
  std::string text = "{";
  for (const auto& [key, value] : entries) {
    if (text.size() > 1) text += ", ";
    text += Printed(key, true, depth - 1) + ": " + Printed(value, true, depth - 1);
  }
  return text + "}";
}

std::string Printed(const Value& value, bool quotes, int depth) {
  if (depth <= 0) return "...";
  if (const auto* truth = value.as<bool>()) return *truth ? "True" : "False";
  if (const auto* number = value.as<std::int64_t>()) return std::to_string(*number);
  if (const auto* number = value.as<double>()) return FloatText(*number);
  if (const auto* text = value.as<std::string>()) return quotes ? Quoted(*text) : *text;
  if (const auto* tuple = value.as<Tuple>()) {
    const std::string items = PrintedItems(*tuple->items, depth);
    return "(" + items + (tuple->items->size() == 1 ? ",)" : ")");
  }
  if (const List* items = value.items()) return "[" + PrintedItems(*items, depth) + "]";
  if (const Dictionary* entries = value.dictionary()) return PrintedEntries(*entries, depth);
  return value.as<const Names*>() != nullptr ? "<namespace>" : "None";
}

double AsNumber(const Value& value) {
  if (const auto* truth = value.as<bool>()) return *truth ? 1 : 0;
  if (const auto* number = value.as<std::int64_t>()) return static_cast<double>(*number);
  return *value.as<double>();
}

bool AreEqualItems(const List& a, const List& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), AreEqual);
}

}  // namespace

const List* Value::items() const {
  if (const auto* list = as<std::shared_ptr<const List>>()) return list->get();
  if (const auto* tuple = as<Tuple>()) return tuple->items.get();
  return nullptr;
}

const Dictionary* Value::dictionary() const {
  const auto* entries = as<std::shared_ptr<const Dictionary>>();
  return entries == nullptr ? nullptr : entries->get();
}

bool Value::is_number() const {
  return as<bool>() != nullptr || as<std::int64_t>() != nullptr || as<double>() != nullptr;
}

Value MakeList(List items) { return {std::make_shared<const List>(std::move(items))}; }
Value MakeTuple(List items) { return {Tuple{std::make_shared<const List>(std::move(items))}}; }
Value MakeDictionary(Dictionary entries) {
  return {std::make_shared<const Dictionary>(std::move(entries))};
}

const char* TypeName(const Value& value) {
  constexpr std::array<const char*, 9> kNames{"None", "bool",  "int",  "float",    "str",
                                              "list", "tuple", "dict", "namespace"};
  return kNames[value.content.index()];
}

std::string ToText(const Value& value) { return Printed(value, false, kMaxTextDepth); }

std::string FloatText(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  std::array<char, 40> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::scientific)
                       .ptr;
  const std::string text(digits.data(), end);
  const std::size_t e = text.find('e');
  const int exponent = std::atoi(text.c_str() + e + 1);
  // As in Python, exponents from -4 to 15 are written as decimals.
  if (exponent < -4 || exponent >= 16) {
    return text.substr(0, e) + "e" + (exponent < 0 ? "-" : "+") +
           (std::abs(exponent) < 10 ? "0" : "") + std::to_string(std::abs(exponent));
  }
  std::string mantissa;
  for (const char c : text.substr(0, e)) {
    if (c != '.' && c != '-') mantissa += c;
  }
  const std::string sign = text.front() == '-' ? "-" : "";
  if (exponent < 0) {
    return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + mantissa;
  }
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  if (mantissa.size() <= whole)
    return sign + mantissa + std::string(whole - mantissa.size(), '0') + ".0";
  return sign + mantissa.substr(0, whole) + "." + mantissa.substr(whole);
}

bool IsTrue(const Value& value) {
  if (value.is_number()) return AsNumber(value) != 0;
  if (const auto* text = value.as<std::string>()) return !text->empty();
  if (const List* items = value.items()) return !items->empty();
  if (const Dictionary* entries = value.dictionary()) return !entries->empty();
  return value.as<const Names*>() != nullptr;
}

bool AreEqual(const Value& a, const Value& b) {
  if (a.is_number() && b.is_number()) return AsNumber(a) == AsNumber(b);
  if (a.content.index() != b.content.index()) return false;
  if (const auto* text = a.as<std::string>()) return *text == *b.as<std::string>();
  if (const List* items = a.items()) return AreEqualItems(*items, *b.items());
  if (const Dictionary* entries = a.dictionary()) {
    const Dictionary& other = *b.dictionary();
    return entries->size() == other.size() &&
           std::all_of(entries->begin(), entries->end(), [&](const auto& entry) {
             return std::any_of(other.begin(), other.end(), [&](const auto& each) {
               return AreEqual(entry.first, each.first) && AreEqual(entry.second, each.second);
             });
           });
  }
  return a.as<const Names*>() == nullptr || *a.as<const Names*>() == *b.as<const Names*>();
}

std::optional<std::int64_t> ParseInteger(const std::string& text) {
  std::string plain = Trimmed(text);
  if (plain.starts_with('+')) plain.erase(0, 1);
  if (plain.empty() || plain.front() == '+') return std::nullopt;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (error != std::errc() || end != plain.data() + plain.size()) return std::nullopt;
  return value;
}

std::optional<double> ParseFloat(const std::string& text) {
  std::string plain = LowerCased(Trimmed(text));
  if (plain.starts_with('+')) plain.erase(0, 1);
  if (plain.empty() || plain.front() == '+') return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (end != plain.data() + plain.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::strtod(plain.c_str(), nullptr);
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

Value FromLiteral(const std::string& text) {
  if (text.size() >= 2 && text.front() == '\'' && text.back() == '\'') {
    return {text.substr(1, text.size() - 2)};
  }
  if (text.find('_') != std::string::npos) return {text};
  if (const auto number = ParseInteger(text)) return {*number};
  if (const auto number = ParseFloat(text)) return {*number};
  if (text == "true" || text == "True") return {true};
  if (text == "false" || text == "False") return {false};
  return {text};
}

std::optional<bool> ConditionOf(const Value& value) {
  const auto* text = value.as<std::string>();
  if (text == nullptr) return IsTrue(value);
  if (*text == "true" || *text == "True") return true;
  if (*text == "false" || *text == "False") return false;
  const auto number = ParseInteger(*text);
  return number ? std::optional(*number != 0) : std::nullopt;
}

}  // namespace gsv::formats::xacro
