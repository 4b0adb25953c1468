#include "gsv/ros2/names.h"

#include <algorithm>

namespace gsv::ros2 {
namespace {

constexpr std::string_view kTopicPrefix = "rt";
constexpr std::string_view kTypeInfix = "::dds_::";

bool IsLetterOrDigit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool IsRosName(std::string_view text) {
  return !text.empty() && !IsDigit(text.front()) &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return IsLetterOrDigit(c) || c == '_'; });
}

void ReplaceAll(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string RosName(std::string_view text) {
  std::string name(text);
  for (char& c : name) {
    if (!IsLetterOrDigit(c)) c = '_';
  }
  if (name.empty() || IsDigit(name.front())) name.insert(name.begin(), '_');
  return name;
}

bool IsNamespace(std::string_view text) {
  if (text == "/") return true;
  while (!text.empty()) {
    if (text.front() != '/') return false;
    text.remove_prefix(1);
    const std::string_view part = text.substr(0, text.find('/'));
    if (!IsRosName(part)) return false;
    text.remove_prefix(part.size());
    if (text.empty()) return true;
  }
  return false;
}

std::string InNamespace(std::string_view name_space, std::string_view name) {
  return (name_space == "/" ? std::string() : std::string(name_space)).append("/").append(name);
}

std::string DdsTopicName(std::string_view topic) { return std::string(kTopicPrefix).append(topic); }

std::string DdsTypeName(std::string_view type) {
  const std::size_t slash = type.rfind('/');
  std::string name(type.substr(0, slash));
  ReplaceAll(name, "/", "::");
  return name.append(kTypeInfix).append(type.substr(slash + 1)).append("_");
}

std::string RosTopicName(std::string_view dds_topic) {
  return dds_topic.starts_with("rt/") ? std::string(dds_topic.substr(2)) : std::string();
}

std::string RosTypeName(std::string_view dds_type) {
  const std::size_t infix = dds_type.find(kTypeInfix);
  if (infix == std::string_view::npos || !dds_type.ends_with('_')) return {};
  std::string name(dds_type.substr(0, infix));
  std::string_view type = dds_type.substr(infix + kTypeInfix.size());
  type.remove_suffix(1);
  ReplaceAll(name, "::", "/");
  return name.append("/").append(type);
}

}  // namespace gsv::ros2
