#include "gsv/scenario/scenario_keys.h"
#include "gsv/scenario/test_keys.h"

namespace gsv::scenario {
namespace {

// The kind of object that a fault affects. The key of the fault determines the kind.
enum class Subject { kSensor, kBehaviour, kMotor, kMove, kJoint };
constexpr std::pair<const char*, Subject> kSubjects[]{{"sensor", Subject::kSensor},
                                                      {"behaviour", Subject::kBehaviour},
                                                      {"motor", Subject::kMotor},
                                                      {"move", Subject::kMove},
                                                      {"joint", Subject::kJoint}};

// Splits "scout/front" into "scout" and "front".
void Split(const std::string& text, Fault& fault) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  fault.body = text.substr(0, slash);
  fault.part = text.substr(std::min(slash + 1, text.size()));
}

void ReadPlace(YamlMapping& mapping, Fault& fault) {
  const auto place = ReadPlaceKeys(mapping);
  if (place) fault.place = *place;
  if (!place && !mapping.Has("x") && !mapping.Has("y")) {
    mapping.AddProblem("x", "the fault needs a position: set x and y");
  }
}

void ReadTarget(YamlMapping& mapping, Fault& fault) {
  constexpr double kMaxTarget = 1e6;
  const std::pair<const char*, Fault::Unit> units[]{{"position", Fault::Unit::kPosition},
                                                    {"velocity", Fault::Unit::kVelocity},
                                                    {"effort", Fault::Unit::kEffort}};
  int given = 0;
  for (const auto& [key, unit] : units) {
    const auto target = mapping.Number(key, -kMaxTarget, kMaxTarget);
    if (mapping.Has(key)) ++given;
    if (!target) continue;
    fault.unit = unit;
    fault.target = *target;
  }
  if (given != 1)
    mapping.AddProblem("give exactly one of 'position', 'velocity' and 'effort' for the joint");
}

Fault ReadFault(YamlMapping& mapping) {
  Fault fault;
  fault.source.text = mapping.Source();
  fault.at = mapping.Number("at", 0, kMaxDuration).value_or(0);
  if (mapping.is_mapping() && !mapping.Has("at")) {
    mapping.AddProblem("at", "the fault needs a time: set at, in seconds");
  }
  std::optional<Subject> subject;
  int subjects = 0;
  for (const auto& [key, of_key] : kSubjects) {
    const auto text = mapping.Text(key);
    if (!mapping.Has(key)) continue;
    ++subjects;
    subject = of_key;
    Split(text.value_or(""), fault);
    const bool needs_part = of_key == Subject::kSensor || of_key == Subject::kJoint;
    const bool may_have_part = needs_part || of_key == Subject::kMotor;
    if (text && (fault.body.empty() || (needs_part && fault.part.empty()))) {
      mapping.AddProblem(key, std::string(key) + " must be as in " +
                                  (needs_part ? "ROBOT/" + std::string(key) : "ROBOT"));
    } else if (text && !may_have_part && !fault.part.empty()) {
      mapping.AddProblem(key, std::string(key) + " must be one name, found \"" + *text + "\"");
    }
  }
  if (mapping.is_mapping() && subjects != 1) {
    mapping.AddProblem(
        "a fault needs exactly one of these keys: sensor, behaviour, motor, move, joint");
  }
  if (!subject) return fault;
  switch (*subject) {
    case Subject::kSensor:
      fault.kind = mapping.IsSecondOf("fails", "silent", "error").value_or(false)
                       ? Fault::Kind::kSensorError
                       : Fault::Kind::kSensorSilent;
      break;
    case Subject::kBehaviour:
      fault.kind = Fault::Kind::kBehaviourDies;
      break;
    case Subject::kMotor:
      fault.kind = Fault::Kind::kMotorFails;
      break;
    case Subject::kMove:
      fault.kind = Fault::Kind::kBodyMoves;
      ReadPlace(mapping, fault);
      break;
    case Subject::kJoint:
      fault.kind = Fault::Kind::kJointMoves;
      ReadTarget(mapping, fault);
      break;
  }
  return fault;
}

}  // namespace

std::vector<Fault> ReadFaults(YamlMapping& scenario) {
  std::vector<Fault> faults;
  scenario.Each("faults", kMaxFaults, [&](const YAML::Node& node, std::string field) {
    YamlMapping mapping(node, std::move(field), scenario.place());
    faults.push_back(ReadFault(mapping));
  });
  return faults;
}

}  // namespace gsv::scenario
