#include "gsv/gateway/curves/field_value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

namespace gsv::gateway::curves {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kMaxListedElements = 8;
constexpr int kMaxDepth = 6;

std::optional<double> Find(const OrderedJson& value, std::string_view key, int depth);

std::optional<double> NumberOf(const OrderedJson& value) {
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  if (!value.is_number()) return std::nullopt;
  return value.get<double>();
}

std::optional<double> AngleIn(const OrderedJson& value, std::string_view which) {
  if (!value.is_object() || value.size() != 4) return std::nullopt;
  double numbers[4];
  static constexpr const char* kNames[] = {"x", "y", "z", "w"};
  for (int i = 0; i < 4; ++i) {
    const auto member = value.find(kNames[i]);
    if (member == value.end() || !member->is_number()) return std::nullopt;
    numbers[i] = member->get<double>();
  }
  return AngleOf(numbers[0], numbers[1], numbers[2], numbers[3], which);
}

// Returns the number of `list` at the position of NAME in `names`. `rest` is "[NAME]".
std::optional<double> BesideName(const OrderedJson& names, const OrderedJson& list,
                                 std::string_view rest) {
  if (!names.is_array() || names.size() != list.size()) return std::nullopt;
  if (rest.size() < 2 || rest.front() != '[' || rest.back() != ']') return std::nullopt;
  const std::string_view wanted = rest.substr(1, rest.size() - 2);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto* name = names[i].get_ptr<const std::string*>();
    if (name != nullptr && *name == wanted) return NumberOf(list[i]);
  }
  return std::nullopt;
}

std::optional<double> ExtremeOf(const OrderedJson& list, std::string_view which) {
  double min = std::numeric_limits<double>::infinity(), max = -min, sum = 0;
  std::size_t finite = 0;
  for (const OrderedJson& each : list) {
    const double value = each.is_number() ? each.get<double>() : NAN;
    if (!std::isfinite(value)) continue;
    min = std::min(min, value);
    max = std::max(max, value);
    sum += value;
    ++finite;
  }
  const bool is_any = finite > 0;
  if (which == "min") return is_any ? min : NAN;
  if (which == "max") return is_any ? max : NAN;
  if (which == "mean") return is_any ? sum / static_cast<double>(finite) : NAN;
  return std::nullopt;
}

std::optional<double> FindInList(const OrderedJson& list, std::string_view key, int depth) {
  const bool is_of_numbers = !list.empty() && list.front().is_number();
  if (!is_of_numbers) {
    if (key == ".count") return static_cast<double>(list.size());
    if (list.empty() || !key.starts_with("[0]")) return std::nullopt;
    key.remove_prefix(3);
    if (key.starts_with('.')) key.remove_prefix(1);
    return Find(list.front(), key, depth + 1);
  }
  if (list.size() > kMaxListedElements) {
    return key.starts_with('.') ? ExtremeOf(list, key.substr(1)) : std::nullopt;
  }
  if (key.size() < 3 || key.front() != '[' || key.back() != ']') return std::nullopt;
  std::size_t index = 0;
  const char* const end = key.data() + key.size() - 1;
  const auto parsed = std::from_chars(key.data() + 1, end, index);
  if (parsed.ec != std::errc() || parsed.ptr != end || index >= list.size()) return std::nullopt;
  return NumberOf(list[index]);
}

std::optional<double> FindInObject(const OrderedJson& object, std::string_view key, int depth) {
  const std::size_t end = std::min(key.find_first_of(".["), key.size());
  const auto member = object.find(std::string(key.substr(0, end)));
  if (member == object.end()) return std::nullopt;
  std::string_view rest = key.substr(end);
  if (member->is_array()) {
    const auto names = object.find("name");
    const bool has_names = names != object.end() && names->is_array() && !names->empty();
    if (has_names && rest.starts_with('[')) {
      if (const auto value = BesideName(*names, *member, rest)) return value;
    }
    return FindInList(*member, rest, depth + 1);
  }
  if (rest.starts_with('.')) rest.remove_prefix(1);
  if (const auto angle = AngleIn(*member, rest)) return angle;
  return Find(*member, rest, depth + 1);
}

std::optional<double> Find(const OrderedJson& value, std::string_view key, int depth) {
  if (depth > kMaxDepth) return std::nullopt;
  if (key.empty()) return NumberOf(value);
  if (value.is_object()) return FindInObject(value, key, depth);
  return value.is_array() ? FindInList(value, key, depth) : std::nullopt;
}

}  // namespace

std::optional<double> AngleOf(double x, double y, double z, double w, std::string_view which) {
  if (which == "roll") return std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y));
  if (which == "pitch") return std::asin(std::clamp(2 * (w * y - z * x), -1.0, 1.0));
  if (which == "yaw") return std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  return std::nullopt;
}

std::optional<double> FieldValue(const nlohmann::ordered_json& message, std::string_view key) {
  if (key.empty() || !message.is_object()) return std::nullopt;
  return FindInObject(message, key, 0);
}

}  // namespace gsv::gateway::curves
