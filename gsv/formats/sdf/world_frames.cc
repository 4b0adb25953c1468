#include "gsv/formats/sdf/world_frames.h"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace gsv::formats {
namespace {

using base::ErrorCode;
using geometry::Pose;

constexpr int kMaxChainLength = 256;

std::vector<double> Numbers(const char* text) {
  std::vector<double> numbers;
  while (text != nullptr && numbers.size() < 8) {
    char* end = nullptr;
    const double number = std::strtod(text, &end);
    if (end == text) break;
    numbers.push_back(number);
    text = end;
  }
  return numbers;
}

bool IsBlank(const char* text) {
  return text == nullptr || std::string(text).find_first_not_of(" \t\r\n") == std::string::npos;
}

}  // namespace

base::Result<WrittenPose> ReadPose(const tinyxml2::XMLElement& element) {
  WrittenPose written;
  const tinyxml2::XMLElement* pose = element.FirstChildElement("pose");
  if (pose == nullptr) return written;
  // Both names are read, because the attribute was called `frame` until SDFormat 1.6.
  for (const char* attribute : {"frame", "relative_to"}) {
    if (const char* value = pose->Attribute(attribute)) written.relative_to = value;
  }
  if (written.relative_to == "world") written.relative_to.clear();
  if (IsBlank(pose->GetText())) return written;

  const std::vector<double> n = Numbers(pose->GetText());
  const char* format = pose->Attribute("rotation_format");
  const bool is_quaternion = format != nullptr && std::string(format) == "quat_xyzw";
  if (n.size() != (is_quaternion ? 7u : 6u)) {
    return Fail(ErrorCode::kBadModel, std::string("<pose> needs ") + (is_quaternion ? "7" : "6") +
                                          " numbers, not \"" + pose->GetText() + "\"");
  }
  written.pose.position = {n[0], n[1], n[2]};
  if (is_quaternion) {
    written.pose.orientation = geometry::Normalized({n[6], n[3], n[4], n[5]});
  } else {
    const double unit = pose->BoolAttribute("degrees", false) ? std::numbers::pi / 180 : 1;
    written.pose.orientation = geometry::FromRollPitchYaw({n[3] * unit, n[4] * unit, n[5] * unit});
  }
  if (!geometry::IsFinite(written.pose)) {
    return Fail(ErrorCode::kBadModel, "<pose> must be finite");
  }
  return written;
}

base::Result<WrittenPose> ReadFramePose(const tinyxml2::XMLElement& frame) {
  auto at = ReadPose(frame);
  const char* const attached_to = frame.Attribute("attached_to");
  const tinyxml2::XMLElement* const pose = frame.FirstChildElement("pose");
  const char* const relative_to = pose == nullptr ? nullptr : pose->Attribute("relative_to");
  // relative_to="world" is not the same as no relative_to.
  const bool is_relative = relative_to != nullptr && *relative_to != '\0';
  if (at && !is_relative && at->relative_to.empty() && attached_to != nullptr) {
    at->relative_to = attached_to;
  }
  return at;
}

void WorldFrames::Add(const std::string& name, WrittenPose at, Pose frame_from_origin,
                      const std::map<std::string, Pose>* inner_frames) {
  entries_[name] = {std::move(at), frame_from_origin, inner_frames};
}

base::Result<Pose> WorldFrames::WorldFrom(const std::string& name) const {
  return Follow(name, kMaxChainLength);
}

base::Result<Pose> WorldFrames::WorldFrom(const WrittenPose& pose) const {
  auto world_from_base = Follow(pose.relative_to, kMaxChainLength);
  if (!world_from_base) return world_from_base;
  return *world_from_base * pose.pose;
}

base::Result<Pose> WorldFrames::Follow(const std::string& name, int links_left) const {
  if (name.empty() || name == "world" || name == "__root__") return Pose{};
  if (links_left == 0) {
    return Fail(ErrorCode::kBadModel,
                "the poses are relative to each other in a cycle that includes \"" + name + "\"");
  }
  auto it = entries_.find(name);
  const std::size_t scope = it == entries_.end() ? name.find("::") : std::string::npos;
  if (scope != std::string::npos) it = entries_.find(name.substr(0, scope));
  if (it == entries_.end()) {
    return Fail(ErrorCode::kBadModel,
                "the pose is relative to the frame \"" + name + "\", which does not exist");
  }
  const Entry& entry = it->second;
  auto world_from_base = Follow(entry.at.relative_to, links_left - 1);
  if (!world_from_base) return world_from_base;
  const Pose world_from_entry = *world_from_base * entry.at.pose * entry.frame_from_origin;
  if (scope == std::string::npos) return world_from_entry;
  if (entry.inner_frames != nullptr) {
    const auto inner = entry.inner_frames->find(name.substr(scope + 2));
    if (inner != entry.inner_frames->end()) return world_from_entry * inner->second;
  }
  return Fail(ErrorCode::kBadModel,
              "the pose is relative to the frame \"" + name + "\", which does not exist");
}

}  // namespace gsv::formats
