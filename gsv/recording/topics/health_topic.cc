#include "gsv/recording/topics/health_topic.h"

#include <algorithm>
#include <utility>

#include "gsv/presentation/health_messages.h"

namespace gsv::recording {
namespace {

constexpr base::SimTime kHealthPeriod = std::chrono::milliseconds(500);
constexpr base::SimTime kWholeEvery = std::chrono::seconds(10);

}  // namespace

HealthTopic::HealthTopic(McapWriter& writer, const Selection& selection,
                         std::shared_ptr<const sensing::SensorRegistry> types, std::uint64_t seed,
                         base::SimTime stuck_after)
    : topic_(writer, selection, presentation::topics::kHealth),
      types_(std::move(types)),
      seed_(seed),
      stuck_after_(stuck_after),
      made_(*types_),
      instants_(kHealthPeriod) {}

base::Result<sensing::Reading> HealthTopic::Read(
    const std::shared_ptr<const world::Snapshot>& snapshot, const std::string& robot,
    const std::string& sensor) {
  const auto list = lists_->find(robot);
  const int body = snapshot->layout->Find(robot);
  if (list == lists_->end() || body < 0) return base::Fail(base::ErrorCode::kNotFound, robot);
  const auto description = std::find_if(list->second.begin(), list->second.end(),
                                        [&](const auto& each) { return each.name == sensor; });
  if (description == list->second.end()) return base::Fail(base::ErrorCode::kNotFound, sensor);
  // Sensors with equal descriptions share one object. `made_` does not own this object, so
  // `sensors_` keeps the object alive.
  auto& held = sensors_[robot + "/" + sensor];
  if (held == nullptr || !(held->description() == *description)) {
    auto made = made_.Of(*description);
    if (!made) return base::Fail(made.error());
    held = *std::move(made);
  }
  return held->Sample({snapshot, body, seed_, rays_});
}

void HealthTopic::Record(const std::shared_ptr<const world::Snapshot>& snapshot,
                         const simulation::SimulationStatus& status) {
  const base::SimTime now = snapshot->state.time;
  if (!topic_.is_wanted() || lists_ == nullptr || !instants_.AdvanceTo(now)) return;
  const health::SensorAccess access{
      [this](const std::string& robot) {
        const auto list = lists_->find(robot);
        return list == lists_->end() ? std::vector<model::SensorDescription>() : list->second;
      },
      [&](const std::string& robot, const std::string& sensor) {
        return Read(snapshot, robot, sensor);
      },
      types_.get()};
  auto message = presentation::HealthMessage(tracker_.Update(status, stuck_after_, access));
  if (written_ && now - written_at_ < kWholeEvery &&
      !presentation::NeedsSending(message, *written_)) {
    return;
  }
  topic_.Write(now, message);
  written_ = std::move(message);
  written_at_ = now;
}

}  // namespace gsv::recording
