#include "gsv/verdict/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "gsv/base/spelling.h"
#include "gsv/sensing/ranges.h"
#include "gsv/simulation/robots/mounted_sensor.h"

namespace gsv::verdict {
namespace {

using QuantityKind = scenario::Quantity::Kind;

std::string Number(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

}  // namespace

std::string Describe(const scenario::Quantity& quantity) {
  const std::string& first = quantity.first;
  switch (quantity.kind) {
    case QuantityKind::kX:
      return "x of " + first;
    case QuantityKind::kY:
      return "y of " + first;
    case QuantityKind::kZ:
      return "z of " + first;
    case QuantityKind::kDistanceToPoint:
      return "the distance of " + first + " from (" + Number(quantity.x) + ", " +
             Number(quantity.y) + ")";
    case QuantityKind::kYawOff:
      return "the yaw of " + first + " relative to " + Number(quantity.yaw) + " rad";
    case QuantityKind::kSpeed:
      return "the speed of " + first;
    case QuantityKind::kTurning:
      return "the turn rate of " + first;
    case QuantityKind::kTravelled:
      return "the distance travelled by " + first;
    case QuantityKind::kDistance:
      return "the distance between " + first + " and " + quantity.second;
    case QuantityKind::kContact:
      return "contact of " + first + (quantity.second.empty() ? "" : " with " + quantity.second);
    case QuantityKind::kSensor:
      return "what " + first + "/" + quantity.second + " reads";
    case QuantityKind::kEnded:
      return "the end of " + first + "'s behaviour";
    case QuantityKind::kTime:
      return "the time";
    case QuantityKind::kStuck:
      return "the time for which " + (first.empty() ? std::string("a robot") : first) +
             " was commanded to move and did not";
  }
  return "";
}

const char* UnitOf(const scenario::Quantity& quantity) {
  switch (quantity.kind) {
    case QuantityKind::kContact:
    case QuantityKind::kSensor:
    case QuantityKind::kEnded:
      return "";
    case QuantityKind::kYawOff:
      return " rad";
    case QuantityKind::kSpeed:
      return " m/s";
    case QuantityKind::kTurning:
      return " rad/s";
    case QuantityKind::kTime:
    case QuantityKind::kStuck:
      return " s";
    default:
      return " m";
  }
}

base::Status Measure::Check(const scenario::Quantity& quantity) const {
  const auto refuse = [](std::string message) {
    return base::Fail(base::ErrorCode::kBadModel, std::move(message));
  };
  if (quantity.kind == QuantityKind::kTime) return {};
  if (quantity.kind == QuantityKind::kStuck && quantity.first.empty()) return {};
  const auto layout = simulation_.snapshot()->layout;
  const bool is_pair = quantity.kind == QuantityKind::kDistance ||
                       (quantity.kind == QuantityKind::kContact && !quantity.second.empty());
  for (const std::string* name : {&quantity.first, is_pair ? &quantity.second : nullptr}) {
    if (name == nullptr || layout->Find(*name) >= 0) continue;
    std::vector<std::string> known;
    for (const world::Body& body : layout->bodies) known.push_back(body.name);
    return refuse("there is no body in the world with the name \"" + *name + "\"" +
                  base::DidYouMean(*name, known));
  }
  if (quantity.kind == QuantityKind::kStuck) {
    if (layout->bodies[static_cast<std::size_t>(layout->Find(quantity.first))].is_robot())
      return {};
    return refuse("\"" + quantity.first + "\" is not a robot");
  }
  if (quantity.kind != QuantityKind::kSensor && quantity.kind != QuantityKind::kEnded) return {};
  const auto agent = simulation_.agent(quantity.first);
  if (agent == nullptr) return refuse("\"" + quantity.first + "\" is not a robot");
  if (quantity.kind == QuantityKind::kEnded) return {};
  const auto sensor = agent->Mounted(quantity.second);
  if (!sensor) return refuse(sensor.error().Sentence());
  if ((*sensor)->takes_long()) {
    return refuse("an image is not a number; \"" + quantity.second + "\" is a camera");
  }
  return {};
}

void Measure::MoveTo(std::shared_ptr<const world::Snapshot> snapshot) {
  snapshot_ = std::move(snapshot);
  is_status_new_ = false;
  motions_.Follow(*snapshot_);
}

double Measure::SecondsStuck(int body) const {
  const simulation::Motion motion = motions_.Of(*snapshot_, body);
  return simulation::IsStuck(motion, base::SimTime(0)) ? base::ToSeconds(motion.commanded_for) : 0;
}

std::optional<double> Measure::OfStuck(const std::string& robot) const {
  const std::string name = robot.empty() ? stuck_longest() : robot;
  if (name.empty()) return 0;
  const int body = snapshot_->layout->Find(name);
  return body < 0 ? std::nullopt : std::optional(SecondsStuck(body));
}

std::string Measure::stuck_longest() const {
  double longest = 0;
  std::string name;
  const auto& bodies = snapshot_->layout->bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].is_robot()) continue;
    const double seconds = SecondsStuck(static_cast<int>(i));
    if (seconds <= longest) continue;
    longest = seconds;
    name = bodies[i].name;
  }
  return name;
}

const world::BodyState* Measure::StateOf(const std::string& body) const {
  const int index = snapshot_->layout->Find(body);
  return index < 0 ? nullptr : &snapshot_->state.bodies[static_cast<std::size_t>(index)];
}

std::span<const double> Measure::WithoutIntensities(const scenario::Quantity& quantity,
                                                    const sensing::Reading::Values& values) const {
  const std::span<const double> all(values.data(), values.size());
  const int index = snapshot_->layout->Find(quantity.first);
  if (index < 0) return all;
  const world::Body& body = snapshot_->layout->bodies[static_cast<std::size_t>(index)];
  for (const model::SensorDescription& sensor : body.model->sensors) {
    if (sensor.name == quantity.second) return sensing::RangesOf(sensor, values);
  }
  return all;
}

std::optional<double> Measure::OfSensor(const scenario::Quantity& quantity) const {
  const auto reading = simulation_.Watch(quantity.first, quantity.second);
  if (!reading || reading->values.empty()) return std::nullopt;
  const auto& values = reading->values;
  const std::span<const double> ranges = WithoutIntensities(quantity, values);
  switch (quantity.take) {
    case scenario::Quantity::Take::kMin:
      return *std::min_element(ranges.begin(), ranges.end());
    case scenario::Quantity::Take::kMax:
      return *std::max_element(ranges.begin(), ranges.end());
    case scenario::Quantity::Take::kMean:
      return std::accumulate(ranges.begin(), ranges.end(), 0.0) /
             static_cast<double>(ranges.size());
    case scenario::Quantity::Take::kOne:
      break;
  }
  const auto index = static_cast<std::size_t>(quantity.value);
  return index < values.size() ? std::optional(values[index]) : std::nullopt;
}

std::optional<double> Measure::OfContact(const scenario::Quantity& quantity) const {
  const world::BodyState* state = StateOf(quantity.first);
  if (state == nullptr) return std::nullopt;
  if (quantity.second.empty()) return state->in_contact ? 1 : 0;
  const int a = snapshot_->layout->Find(quantity.first);
  const int b = snapshot_->layout->Find(quantity.second);
  const bool touch = std::any_of(
      snapshot_->contacts.begin(), snapshot_->contacts.end(), [&](const world::Contact& c) {
        return !c.supports && ((c.first == a && c.second == b) || (c.first == b && c.second == a));
      });
  return touch ? 1 : 0;
}

bool Measure::HasEnded(const std::string& robot) {
  if (!is_status_new_) {
    auto status = simulation_.status();
    // At the end of a run, the simulation ends all behaviours. So the last state does not show
    // which behaviours have ended by themselves, and the state before it is used.
    using simulation::Phase;
    const bool is_over = status.phase == Phase::kFinished || status.phase == Phase::kFailed ||
                         status.phase == Phase::kStopped;
    if (!is_over) status_ = std::move(status);
    is_status_new_ = true;
  }
  if (!status_) return false;
  return std::any_of(status_->robots.begin(), status_->robots.end(), [&](const auto& each) {
    using simulation::AgentPhase;
    return each.name == robot &&
           (each.phase == AgentPhase::kFinished || each.phase == AgentPhase::kDead ||
            each.phase == AgentPhase::kUnresponsive);
  });
}

std::optional<double> Measure::Of(const scenario::Quantity& quantity) {
  switch (quantity.kind) {
    case QuantityKind::kTime:
      return base::ToSeconds(snapshot_->state.time);
    case QuantityKind::kSensor:
      return OfSensor(quantity);
    case QuantityKind::kContact:
      return OfContact(quantity);
    case QuantityKind::kEnded:
      return HasEnded(quantity.first) ? 1 : 0;
    case QuantityKind::kStuck:
      return OfStuck(quantity.first);
    default:
      break;
  }
  const world::BodyState* state = StateOf(quantity.first);
  if (state == nullptr) return std::nullopt;
  const geometry::Vector3& p = state->world_from_model.position;
  switch (quantity.kind) {
    case QuantityKind::kX:
      return p.x;
    case QuantityKind::kY:
      return p.y;
    case QuantityKind::kZ:
      return p.z;
    case QuantityKind::kDistanceToPoint:
      return std::hypot(p.x - quantity.x, p.y - quantity.y);
    case QuantityKind::kYawOff: {
      const double off = geometry::Yaw(state->world_from_model.orientation) - quantity.yaw;
      return std::abs(std::remainder(off, 2 * std::numbers::pi));
    }
    case QuantityKind::kSpeed:
      return geometry::Norm(state->linear_velocity);
    case QuantityKind::kTurning:
      return std::abs(state->angular_velocity.z);
    case QuantityKind::kTravelled:
      return state->distance;
    case QuantityKind::kDistance: {
      const world::BodyState* other = StateOf(quantity.second);
      if (other == nullptr) return std::nullopt;
      const geometry::Vector3& q = other->world_from_model.position;
      return std::hypot(p.x - q.x, p.y - q.y);
    }
    default:
      return std::nullopt;
  }
}

}  // namespace gsv::verdict
