#include "gsv/presentation/edit_message.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <sstream>
#include <string>

#include "gsv/messages/time.h"

namespace gsv::presentation {
namespace {

using simulation::Edit;

constexpr std::uint64_t kMaxSteps = std::uint64_t{1} << 62;
constexpr Edit::Kind kKinds[]{Edit::Kind::kAddRobot, Edit::Kind::kAddAvatar, Edit::Kind::kAddObject,
                              Edit::Kind::kRemove,   Edit::Kind::kPlace,     Edit::Kind::kCommand};
constexpr Edit::Moment kMoments[]{Edit::Moment::kBeforeTurns, Edit::Moment::kAfterTurns,
                                  Edit::Moment::kAmidTurns};
// In the field `movement` of an edit message, a drive choice (model/drive_choice.h) follows this
// word.
const std::string kDrive = " drive ";
constexpr model::Movement kMovements[]{model::Movement::kPlanar, model::Movement::kRigid};

const char* ToString(model::Movement movement) {
  return movement == model::Movement::kRigid ? "rigid" : "planar";
}

// Returns the value of an enumeration with that name.
template <typename Value, std::size_t kCount>
std::optional<Value> Named(const std::string& name, const Value (&values)[kCount]) {
  const auto found = std::find_if(std::begin(values), std::end(values),
                                  [&](Value value) { return name == ToString(value); });
  return found == std::end(values) ? std::nullopt : std::optional(*found);
}

using Texts = std::map<std::string, std::string>;

// Writes one argument per line, such as "z=-1.62".
std::string Lines(const Texts& arguments) {
  std::string lines;
  for (const auto& [name, value] : arguments) lines += name + "=" + value + "\n";
  return lines;
}

Texts FromLines(const std::string& lines) {
  Texts arguments;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t sign = std::min(line.find('='), line.size());
    arguments[line.substr(0, sign)] = line.substr(std::min(sign + 1, line.size()));
  }
  return arguments;
}

}  // namespace

messages::gsv_msgs::Edit EditMessage(const simulation::Edit& edit) {
  messages::gsv_msgs::Edit message;
  message.stamp = messages::ToMessage(edit.time);
  message.step = static_cast<std::uint64_t>(edit.step);
  message.kind = ToString(edit.kind);
  message.moment = ToString(edit.moment);
  message.halt = edit.halt;
  const bool is_command = edit.kind == Edit::Kind::kCommand;
  message.body = is_command ? edit.command : edit.body;
  message.model = is_command ? Lines(edit.arguments) : edit.model;
  message.copy_of = edit.copy_of;
  message.behaviour = edit.behaviour;
  if (edit.movement) message.movement = ToString(*edit.movement);
  if (!edit.drive.empty()) message.movement += kDrive + edit.drive;
  const auto& [p, q] = edit.world_from_body;
  message.pose.position = {p.x, p.y, p.z};
  message.pose.orientation.x = q.x;
  message.pose.orientation.y = q.y;
  message.pose.orientation.z = q.z;
  message.pose.orientation.w = q.w;
  message.on_ground = edit.on_ground;
  return message;
}

base::Result<simulation::Edit> EditFrom(const messages::gsv_msgs::Edit& message) {
  const auto& [p, q] = message.pose;
  const auto kind = Named(message.kind, kKinds);
  const auto moment = Named(message.moment, kMoments);
  simulation::Edit edit;
  // The field `movement` also contains the drive, because a new field would make older recordings
  // unreadable (ADR 034).
  const std::size_t drive = message.movement.find(kDrive);
  const std::string movement = message.movement.substr(0, drive);
  if (drive != std::string::npos) edit.drive = message.movement.substr(drive + kDrive.size());
  edit.movement = Named(movement, kMovements);
  edit.world_from_body = {{p.x, p.y, p.z}, {q.w, q.x, q.y, q.z}};
  const double length = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  if (!kind || !moment || message.body.empty() || message.step > kMaxSteps ||
      (!edit.movement && !movement.empty()) || !geometry::IsFinite(edit.world_from_body) ||
      !(std::abs(length - 1) < 1e-6)) {
    return base::Fail(base::ErrorCode::kCorrupt, "the recording has an invalid edit", message.body);
  }
  edit.step = static_cast<std::int64_t>(message.step);
  edit.time = messages::ToSimTime(message.stamp);
  edit.kind = *kind;
  edit.moment = *moment;
  edit.halt = message.halt;
  if (edit.kind == Edit::Kind::kCommand) {
    edit.command = message.body;
    edit.arguments = FromLines(message.model);
  } else {
    edit.body = message.body;
    edit.model = message.model;
  }
  edit.copy_of = message.copy_of;
  edit.behaviour = message.behaviour;
  edit.on_ground = message.on_ground;
  return edit;
}

}  // namespace gsv::presentation
