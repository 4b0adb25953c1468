#include "gsv/gateway/live/sensor_topics.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/presentation/state_messages.h"
#include "gsv/presentation/topics.h"
#include "gsv/world/station.h"

namespace gsv::gateway {
namespace {

constexpr double kBeamsRate = 15;  // Hz
constexpr double kReadingsRate = 15;
constexpr double kImagesRate = 5;
// Slow sensors, such as a camera that sees a thousand robots, are read less often: the time between
// two readings is at least this number times the duration of the last reading. So the readings of a
// sensor take at most a tenth of a processor's time. Viewers must not slow down the simulation, nor
// the page that shows it on the same machine.
constexpr int kShareOfProcessors = 10;

}  // namespace

// One sensor of one robot. The members that workers use are constant or atomic.
struct SensorTopics::Sensor {
  using Made = base::Result<std::shared_ptr<const sensing::Sensor>>;

  Sensor(std::string its_robot, model::SensorDescription its_description,
         const sensing::SensorType* its_type, Made its_made)
      : robot(std::move(its_robot)),
        description(std::move(its_description)),
        type(its_type),
        messages(type->MessagesOf(description)),
        made(std::move(its_made)),
        pacing(type->overlay == sensing::Overlay::kImage ? kImagesRate : kReadingsRate) {}

  const std::string robot;
  const model::SensorDescription description;
  const sensing::SensorType* const type;
  const sensing::SensorMessages messages;
  const Made made;  // encodes the sensor's messages
  std::string frame() const { return presentation::FrameOf(robot, description.name); }
  // Returns whether the companion topic has a message for each reading, as camera_info has one for
  // each image. If not, each new subscriber to the companion topic gets one message.
  bool has_companion_of_readings() const {
    return messages.companion && messages.companion->of_readings;
  }

  foxglove::ChannelId channel = 0;            // 0: none
  foxglove::ChannelId companion_channel = 0;  // 0: none
  // True if the sensor's channels exist because a client has requested the robot.
  bool is_wanted = false;
  Pacing pacing;
  // Step of the latest snapshot when the last reading was requested.
  std::optional<std::int64_t> asked_at_step;
  WallTime asked_at{};
  std::atomic<std::chrono::nanoseconds> took{};  // duration of the last reading
  std::atomic<bool> is_busy{false};
  std::atomic<std::int64_t> published_step{-1};  // step of the last published reading
  std::atomic<bool> has_complained{false};
};

SensorTopics::SensorTopics(std::shared_ptr<Hub> hub, WorkerPool& workers)
    : hub_(std::move(hub)),
      workers_(workers),
      beam_sensors_(std::make_shared<SensorList>()),
      beams_pacing_(kBeamsRate),
      robot_beams_(hub_, workers) {
  const auto channels = hub_->Advertise({ChannelFor(presentation::topics::kBeams),
                                         ChannelFor(presentation::topics::kSensorTransforms)});
  beams_channel_ = channels[0];
  transforms_channel_ = channels[1];
}

void SensorTopics::Refresh(simulation::Simulation& simulation, const world::Snapshot& snapshot) {
  Sensors found = ListSensors(simulation, *snapshot.layout);
  const bool has_requests = wanted_.TakeRequests();
  if (found == sensors_ && !has_requests) return;
  Withdraw(found);
  EvictUnsubscribed(found);
  Advertise(found);
  sensors_ = std::move(found);
  SensorList with_beams;
  for (const auto& [topic, sensor] : sensors_) {
    const bool has_lines = presentation::HasLines(*sensor->type, sensor->description);
    if (has_lines && sensor->made) with_beams.push_back(sensor);
  }
  beam_sensors_ = std::make_shared<SensorList>(std::move(with_beams));
  by_channel_.clear();
  for (const auto& [topic, sensor] : sensors_) {
    if (sensor->channel != 0) by_channel_.emplace(sensor->channel, sensor);
    if (sensor->companion_channel != 0) by_channel_.emplace(sensor->companion_channel, sensor);
  }
  beams_of_.reset();
  transforms_changed_ = true;
  robot_beams_.Refresh(WantedBeams());
}

RobotBeams::Sources SensorTopics::WantedBeams() const {
  RobotBeams::Sources sources;
  for (const std::shared_ptr<Sensor>& sensor : *beam_sensors_) {
    if (!wanted_.Contains(sensor->robot)) continue;
    sources[sensor->robot].push_back({sensor->description.name, sensor->type, *sensor->made});
  }
  return sources;
}

// Returns the sensors that exist now. A sensor that existed before keeps its state.
SensorTopics::Sensors SensorTopics::ListSensors(simulation::Simulation& simulation,
                                                const world::Layout& layout) {
  if (!made_) made_.emplace(simulation.sensor_types());
  Sensors found;
  for (const world::Body& body : layout.bodies) {
    if (!world::HasAgent(body)) continue;
    for (model::SensorDescription& description : simulation.sensors(body.name)) {
      const sensing::SensorType* type = simulation.sensor_types().Find(description.type);
      if (type == nullptr) continue;
      const std::string topic = presentation::SensorTopic(body.name, description.name);
      const auto known = sensors_.find(topic);
      if (known != sensors_.end() && known->second->description == description) {
        found.insert(*known);
        continue;
      }
      auto made = made_->Of(description);
      found.emplace(topic, std::make_shared<Sensor>(body.name, std::move(description), type,
                                                    std::move(made)));
    }
  }
  return found;
}

void SensorTopics::Withdraw(const Sensors& found) {
  std::vector<foxglove::ChannelId> gone;
  for (const auto& [topic, sensor] : sensors_) {
    const auto still = found.find(topic);
    if (still != found.end() && still->second == sensor) continue;
    for (const foxglove::ChannelId channel : {sensor->channel, sensor->companion_channel}) {
      if (channel == 0) continue;
      gone.push_back(channel);
      if (!sensor->is_wanted) --topics_;
    }
  }
  hub_->Unadvertise(gone);
}

void SensorTopics::EvictUnsubscribed(Sensors& found) {
  const std::set<std::string> forgotten =
      wanted_.EvictUnsubscribed([this] { return SubscribedRobots(); });
  if (forgotten.empty()) return;
  std::vector<foxglove::ChannelId> gone;
  for (auto& [topic, sensor] : found) {
    if (!sensor->is_wanted || !forgotten.contains(sensor->robot)) continue;
    for (const foxglove::ChannelId channel : {sensor->channel, sensor->companion_channel}) {
      if (channel != 0) gone.push_back(channel);
    }
    // The old object is replaced and not changed, because a worker may still use it.
    sensor =
        std::make_shared<Sensor>(sensor->robot, sensor->description, sensor->type, sensor->made);
  }
  hub_->Unadvertise(gone);
}

std::set<std::string> SensorTopics::SubscribedRobots() const {
  std::set<std::string> robots = robot_beams_.SubscribedRobots();
  for (const foxglove::ChannelId channel : hub_->SubscribedChannels()) {
    const auto found = by_channel_.find(channel);
    if (found != by_channel_.end()) robots.insert(found->second->robot);
  }
  return robots;
}

void SensorTopics::Advertise(Sensors& found) {
  std::vector<foxglove::Channel> channels;
  std::vector<std::pair<std::shared_ptr<Sensor>, foxglove::ChannelId Sensor::*>> fresh;
  bool is_all = true;
  for (const auto& [topic, sensor] : found) {
    if (sensor->channel != 0 || sensor->messages.schema == nullptr) continue;
    sensor->is_wanted = wanted_.Contains(sensor->robot);
    if (!sensor->is_wanted && topics_ >= kMaxSensorTopics) {
      is_all = false;
      continue;
    }
    channels.push_back(ChannelFor(topic, *sensor->messages.schema));
    fresh.emplace_back(sensor, &Sensor::channel);
    if (const auto& companion = sensor->messages.companion) {
      channels.push_back(
          ChannelFor(presentation::CompanionTopic(topic, *companion), *companion->schema));
      fresh.emplace_back(sensor, &Sensor::companion_channel);
    }
    if (!sensor->is_wanted) topics_ += sensor->messages.companion ? 2 : 1;
  }
  const std::vector<foxglove::ChannelId> ids = hub_->Advertise(std::move(channels));
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto& [sensor, channel] = fresh[i];
    (*sensor).*channel = ids[i];
    hub_->SetPublishers(ids[i], {sensor->robot});
  }
  if (!is_all && !std::exchange(limit_reported_, true)) {
    hub_->SendStatus(
        foxglove::StatusLevel::kInfo,
        "there are more sensors than topics: the first " + std::to_string(kMaxSensorTopics) +
            " have a topic of their own, the others get one when a viewer selects their robot "
            "(docs/formats/live.md)");
  }
}

void SensorTopics::Publish(const std::shared_ptr<simulation::Simulation>& simulation,
                           const std::shared_ptr<const world::Snapshot>& snapshot, WallTime now) {
  PublishTransforms(*snapshot);
  // Loops over the subscribed channels only, because a thousand robots have thousands of sensors.
  for (const foxglove::ChannelId channel : hub_->SubscribedChannels()) {
    const auto found = by_channel_.find(channel);
    if (found == by_channel_.end()) continue;
    const std::shared_ptr<Sensor>& sensor = found->second;
    if (channel == sensor->companion_channel && !sensor->has_companion_of_readings()) {
      SendCompanion(*snapshot, *sensor);
    } else {
      PublishReading(simulation, *snapshot, now, sensor);
    }
  }
  PublishBeams(simulation, snapshot, now);
  robot_beams_.Publish(simulation, snapshot, now);
}

void SensorTopics::PublishTransforms(const world::Snapshot& snapshot) {
  const bool is_wanted = hub_->HasNewSubscribers(transforms_channel_) ||
                         (transforms_changed_ && hub_->IsSubscribed(transforms_channel_));
  if (!is_wanted) return;
  messages::tf2_msgs::TFMessage message;
  for (const auto& [topic, sensor] : sensors_) {
    const int body = snapshot.layout->Find(sensor->robot);
    if (body < 0) continue;
    presentation::AppendSensorTransform(*snapshot.layout, body, sensor->description, *sensor->type,
                                        snapshot.state.time, message);
  }
  hub_->Publish(transforms_channel_, {base::NanosecondsOf(snapshot.state.time), Encoded(message)});
  transforms_changed_ = false;
}

// A companion message that depends only on the sensor's description never changes. Each new
// subscriber gets it once, even if nobody subscribes to the readings.
void SensorTopics::SendCompanion(const world::Snapshot& snapshot, const Sensor& sensor) {
  if (!hub_->HasNewSubscribers(sensor.companion_channel)) return;
  if (!sensor.made) return hub_->Welcome(sensor.companion_channel, {});
  const base::SimTime time = snapshot.state.time;
  const Hub::Message message{base::NanosecondsOf(time),
                             SharedBytes((*sensor.made)->EncodeCompanion(time, sensor.frame()))};
  hub_->Welcome(sensor.companion_channel, {&message, 1});
}

bool SensorTopics::HasNewSubscribers(const Sensor& sensor) const {
  return hub_->HasNewSubscribers(sensor.channel) ||
         (sensor.has_companion_of_readings() && hub_->HasNewSubscribers(sensor.companion_channel));
}

void SensorTopics::PublishReading(const std::shared_ptr<simulation::Simulation>& simulation,
                                  const world::Snapshot& snapshot, WallTime now,
                                  const std::shared_ptr<Sensor>& sensor) {
  if (sensor->is_busy) return;
  const bool is_due = sensor->asked_at_step != snapshot.state.step && sensor->pacing.IsDue(now) &&
                      now - sensor->asked_at >= kShareOfProcessors * sensor->took.load();
  if (!is_due && !HasNewSubscribers(*sensor)) return;
  sensor->is_busy = true;
  const bool accepted = workers_.Submit([self = shared_from_this(), simulation, sensor] {
    const auto began = std::chrono::steady_clock::now();
    self->ReadSensor(*simulation, *sensor);
    sensor->took = std::chrono::steady_clock::now() - began;
    sensor->is_busy = false;
  });
  if (!accepted) {
    sensor->is_busy = false;  // the workers are busy; the next call tries again
    return;
  }
  sensor->asked_at_step = snapshot.state.step;
  sensor->asked_at = now;
  sensor->pacing.Done(now);
}

void SensorTopics::ReadSensor(simulation::Simulation& simulation, Sensor& sensor) {
  const auto refuse = [&](const base::Error& error) {
    // Ends the wait of new subscribers for a first message. Otherwise Publish() would read the
    // sensor again for them each time, and fail each time.
    hub_->Welcome(sensor.channel, {});
    if (sensor.has_companion_of_readings()) hub_->Welcome(sensor.companion_channel, {});
    if (sensor.has_complained.exchange(true)) return;
    hub_->SendStatus(foxglove::StatusLevel::kWarning, error.Sentence());
  };
  const base::Result<sensing::Reading> reading =
      simulation.Watch(sensor.robot, sensor.description.name);
  if (!reading) return refuse(reading.error());
  if (!sensor.made) return refuse(sensor.made.error());
  const bool is_new = sensor.published_step.exchange(reading->step) != reading->step;
  if (!is_new && !HasNewSubscribers(sensor)) return;
  const sensing::Sensor& its = **sensor.made;
  auto encoded = its.Encode(*reading, sensor.frame());
  if (!encoded) return refuse(encoded.error());
  const std::uint64_t time = base::NanosecondsOf(reading->time);
  const Hub::Message message{time, SharedBytes(*std::move(encoded))};
  if (is_new) {
    hub_->Publish(sensor.channel, message);
  } else {
    hub_->Welcome(sensor.channel, {&message, 1});
  }
  if (sensor.companion_channel == 0 || !hub_->IsSubscribed(sensor.companion_channel)) return;
  if (!is_new && !sensor.has_companion_of_readings()) return;
  const Hub::Message companion{time, SharedBytes(its.EncodeCompanionOf(*reading, sensor.frame()))};
  if (is_new) {
    hub_->Publish(sensor.companion_channel, companion);
  } else {
    hub_->Welcome(sensor.companion_channel, {&companion, 1});
  }
}

void SensorTopics::PublishBeams(const std::shared_ptr<simulation::Simulation>& simulation,
                                const std::shared_ptr<const world::Snapshot>& snapshot,
                                WallTime now) {
  if (beams_busy_ || !hub_->IsSubscribed(beams_channel_)) return;
  const bool is_due = beams_of_.lock() != snapshot && beams_pacing_.IsDue(now);
  if (!is_due && !hub_->HasNewSubscribers(beams_channel_)) return;
  beams_busy_ = true;
  const bool accepted =
      workers_.Submit([self = shared_from_this(), simulation, snapshot, sensors = beam_sensors_] {
        self->ReadBeams(*simulation, *snapshot, *sensors);
        self->beams_busy_ = false;
      });
  if (!accepted) {
    beams_busy_ = false;
    return;
  }
  beams_of_ = snapshot;
  beams_pacing_.Done(now);
}

void SensorTopics::ReadBeams(simulation::Simulation& simulation, const world::Snapshot& snapshot,
                             const SensorList& sensors) {
  for (const std::shared_ptr<Sensor>& sensor : sensors) {
    const int body = snapshot.layout->Find(sensor->robot);
    if (body < 0) continue;
    const auto reading = simulation.Watch(sensor->robot, sensor->description.name);
    if (reading) beam_markers_.Add(snapshot, body, *sensor->type, **sensor->made, *reading);
  }
  hub_->Publish(beams_channel_, {base::NanosecondsOf(snapshot.state.time),
                                 Encoded(beam_markers_.Take(snapshot.state.time))});
}

}  // namespace gsv::gateway
