#include "gsv/model/drive_choice.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include "gsv/base/spelling.h"
#include "gsv/model/drive_guess.h"

namespace gsv::model {
namespace {

using base::ErrorCode;

constexpr const char* kExpected =
    "; expected KIND[,KEY=VALUE]… with KIND diff, skid, ackermann, mecanum, omni or none, and KEY "
    "left, right, steer, radius, separation, wheel_base or steering_limit";

struct NamedKind {
  const char* name;
  DriveKind kind;
};
constexpr NamedKind kKinds[] = {
    {"diff", DriveKind::kDifferential}, {"differential", DriveKind::kDifferential},
    {"skid", DriveKind::kDifferential}, {"ackermann", DriveKind::kAckermann},
    {"mecanum", DriveKind::kMecanum},   {"omni", DriveKind::kVelocity},
    {"velocity", DriveKind::kVelocity}, {"none", DriveKind::kNone},
};

std::vector<std::string> SplitAt(char separator, const std::string& text) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (;;) {
    const std::size_t at = text.find(separator, from);
    parts.push_back(text.substr(from, at - from));
    if (at == std::string::npos) return parts;
    from = at + 1;
  }
}

std::optional<double> PositiveNumber(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  return is_whole && value > 0 && value < 1e6 ? std::optional(value) : std::nullopt;
}

class ChoiceReader {
 public:
  explicit ChoiceReader(const std::string& text) : text_(text) {}

  base::Result<DriveChoice> Read() {
    const std::vector<std::string> parts = SplitAt(',', text_);
    const auto* kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                    [&](const auto& known) { return parts.front() == known.name; });
    if (kind == std::end(kKinds)) {
      std::vector<std::string> names;
      for (const auto& known : kKinds) names.emplace_back(known.name);
      return Refuse("there is no drive \"" + parts.front() + "\"",
                    base::DidYouMean(parts.front(), names));
    }
    choice_.kind = kind->kind;
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const std::size_t equals = parts[i].find('=');
      if (equals == std::string::npos) return Refuse("\"" + parts[i] + "\" is not KEY=VALUE");
      const std::string key = parts[i].substr(0, equals), value = parts[i].substr(equals + 1);
      if (auto ok = Take(key, value); !ok) return base::Fail(ok.error());
    }
    return std::move(choice_);
  }

 private:
  base::Failure<base::Error> Refuse(const std::string& why, const std::string& hint = "") const {
    return base::Fail(ErrorCode::kInvalidArgument, why + kExpected + hint, text_);
  }

  base::Status Take(const std::string& key, const std::string& value) {
    const std::pair<const char*, std::vector<std::string>*> lists[] = {
        {"left", &choice_.left}, {"right", &choice_.right}, {"steer", &choice_.steer}};
    for (const auto& [name, joints] : lists) {
      if (key != name) continue;
      if (value.empty()) return Refuse(key + " names no joint");
      joints->push_back(value);
      return {};
    }
    const std::pair<const char*, std::optional<double>*> numbers[] = {
        {"radius", &choice_.radius},
        {"separation", &choice_.separation},
        {"wheel_base", &choice_.wheel_base},
        {"steering_limit", &choice_.steering_limit}};
    for (const auto& [name, number] : numbers) {
      if (key != name) continue;
      *number = PositiveNumber(value);
      if (*number) return {};
      return Refuse(key + " must be a number above zero, not \"" + value + "\"");
    }
    return Refuse("there is no key \"" + key + "\"",
                  base::DidYouMean(key, {"left", "right", "steer", "radius", "separation",
                                         "wheel_base", "steering_limit"}));
  }

  const std::string& text_;
  DriveChoice choice_;
};

std::string Names(const Model& model, const std::vector<int>& joints) {
  std::string names;
  for (const int joint : joints) {
    names += (names.empty() ? "" : ", ") + model.joints[static_cast<std::size_t>(joint)].name;
  }
  return names;
}

// Appends the joints with these names. A name that contains "+" is a list of names, unless a joint
// has that name.
base::Status FindJoints(const Model& model, const std::vector<std::string>& names,
                        std::vector<int>& joints) {
  if (names.empty()) return {};
  joints.clear();
  for (const std::string& name : names) {
    const bool is_one = FindJoint(model.joints, name) >= 0;
    for (const std::string& each : is_one ? std::vector{name} : SplitAt('+', name)) {
      const int joint = FindJoint(model.joints, each);
      if (joint < 0) {
        std::string movable;
        for (const Joint& other : model.joints) {
          if (TakesCommands(other.kind)) movable += (movable.empty() ? "" : ", ") + other.name;
        }
        return base::Fail(ErrorCode::kBadModel,
                          "the model has no movable joint \"" + each + "\"; it has " +
                              (movable.empty() ? "none" : movable),
                          model.name);
      }
      joints.push_back(joint);
    }
  }
  return {};
}

// Returns the drive to which the user's choice is applied: the model's drive if it has that kind.
// If not, returns a drive of that kind with the wheels that GuessDrive() finds. A drive of kind
// kVelocity or kNone has no wheels.
Drive StartFrom(const Model& model, DriveKind kind) {
  if (model.drive && model.drive->kind == kind) return *model.drive;
  Drive guess = GuessDrive(model);
  guess.kind = kind;
  if (kind != DriveKind::kAckermann) guess.steered.clear();
  if (kind == DriveKind::kVelocity || kind == DriveKind::kNone) {
    guess.left_wheels.clear();
    guess.right_wheels.clear();
  }
  return guess;
}

base::Result<Drive> Choose(const Model& model, const DriveChoice& choice) {
  Drive drive = StartFrom(model, choice.kind);
  if (auto ok = FindJoints(model, choice.left, drive.left_wheels); !ok)
    return base::Fail(ok.error());
  if (auto ok = FindJoints(model, choice.right, drive.right_wheels); !ok)
    return base::Fail(ok.error());
  if (auto ok = FindJoints(model, choice.steer, drive.steered); !ok) return base::Fail(ok.error());
  const bool rolls = choice.kind != DriveKind::kVelocity && choice.kind != DriveKind::kNone;
  if (rolls && (drive.left_wheels.empty() || drive.right_wheels.empty())) {
    return base::Fail(ErrorCode::kBadModel,
                      "no wheels are found for this drive; name their joints with left=… and "
                      "right=…",
                      model.name);
  }
  const bool is_named = !choice.left.empty() || !choice.right.empty() || !choice.steer.empty();
  if (is_named || drive.origin == DriveOrigin::kGuessed) MeasureDrive(model, drive);
  if (choice.radius) drive.wheel_radius = *choice.radius;
  if (choice.separation) drive.wheel_separation = *choice.separation;
  if (choice.wheel_base) drive.wheel_base = *choice.wheel_base;
  if (choice.steering_limit) drive.steering_limit = *choice.steering_limit;
  if (choice.kind == DriveKind::kAckermann && !(drive.wheel_base > 0)) {
    return base::Fail(ErrorCode::kBadModel,
                      "no steered front wheels are found; name their joints with steer=…, or give "
                      "wheel_base=…",
                      model.name);
  }
  return drive;
}

bool CanBehave(const Model& model) {
  return !model.sensors.empty() ||
         std::any_of(model.joints.begin(), model.joints.end(),
                     [](const Joint& joint) { return TakesCommands(joint.kind); });
}

std::shared_ptr<const Model> With(const Model& model, Drive drive) {
  auto robot = std::make_shared<Model>(model);
  robot->drive = std::move(drive);
  return robot;
}

const char* TextOf(const Drive& drive) {
  switch (drive.kind) {
    case DriveKind::kDifferential:
      return drive.left_wheels.size() > 1 ? "skid steering" : "differential";
    case DriveKind::kSynchro:
      return "synchro";
    case DriveKind::kAckermann:
      return "Ackermann";
    case DriveKind::kMecanum:
      return "mecanum";
    case DriveKind::kVelocity:
      return "omnidirectional";
    case DriveKind::kNone:
      return "none";
  }
  return "";
}

std::string Metres(const char* what, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%s %.4g m", what, value);
  return text;
}

std::string WithoutWheels(const Model& model, const Drive& drive) {
  if (drive.origin != DriveOrigin::kGuessed) return "";
  if (drive.kind == DriveKind::kVelocity) return ", guessed from its steered wheels";
  const auto movable = std::count_if(model.joints.begin(), model.joints.end(),
                                     [](const Joint& joint) { return TakesCommands(joint.kind); });
  return ", since no wheels are found; the base stands still, " + std::to_string(movable) +
         " joints take commands";
}

}  // namespace

base::Result<DriveChoice> ParseDriveChoice(const std::string& text) {
  return ChoiceReader(text).Read();
}

base::Result<std::shared_ptr<const Model>> AsRobot(std::shared_ptr<const Model> model,
                                                   const std::string& choice) {
  if (choice.empty()) {
    if (model->drive) return model;
    Drive guess = GuessDrive(*model);
    if (guess.kind == DriveKind::kNone && !CanBehave(*model)) {
      return base::Fail(
          ErrorCode::kBadModel,
          "the model \"" + model->name +
              "\" has neither a drive nor wheels, movable joints or sensors, so it "
              "cannot be a robot; choose a drive with --drive, or add it as an object",
          model->source);
    }
    return With(*model, std::move(guess));
  }
  const auto read = ParseDriveChoice(choice);
  if (!read) return base::Fail(read.error());
  auto drive = Choose(*model, *read);
  if (!drive) return base::Fail(drive.error());
  drive->origin = DriveOrigin::kChosen;
  drive->choice = choice;
  return With(*model, *std::move(drive));
}

std::string DescribeDrive(const Model& model) {
  const Drive& drive = *model.drive;
  std::string text = TextOf(drive);
  if (drive.left_wheels.empty() && drive.right_wheels.empty()) {
    return text + WithoutWheels(model, drive);
  }
  const bool is_guessed = drive.origin == DriveOrigin::kGuessed;
  std::vector<int> wheels = drive.left_wheels;
  wheels.insert(wheels.end(), drive.right_wheels.begin(), drive.right_wheels.end());
  text += is_guessed ? ", guessed from wheels " : " on wheels ";
  text += Names(model, wheels);
  if (!drive.steered.empty()) {
    text += drive.kind == DriveKind::kAckermann ? ", steered by "
                                                : ", with the steering joints held straight: ";
    text += Names(model, drive.steered);
  }
  text += "; " + Metres("radius", drive.wheel_radius) + ", " +
          Metres("separation", drive.wheel_separation);
  if (drive.kind == DriveKind::kAckermann) text += ", " + Metres("wheel base", drive.wheel_base);
  return text;
}

}  // namespace gsv::model
