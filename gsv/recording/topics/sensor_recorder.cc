#include "gsv/recording/topics/sensor_recorder.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "gsv/base/log.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/presentation/state_messages.h"
#include "gsv/sensing/encoding.h"

namespace gsv::recording {
namespace {

// Limits for slow sensors such as cameras: how many readings are requested together, so that the
// renderer draws them together, and how many readings are stored.
constexpr int kSlowAtOnce = 16;
constexpr std::size_t kMaxSlowSensors = 64;

// Returns the period of the recorded readings: the smallest multiple of the sensor's period that
// gives at most `rate` readings per second.
base::SimTime PeriodOf(const model::SensorDescription& description, double rate) {
  if (description.update_rate <= 0) return base::FromSeconds(1 / rate);
  const base::SimTime own = base::FromSeconds(1 / description.update_rate);
  const double periods = std::max(1.0, std::ceil(description.update_rate / rate - 1e-9));
  return own * static_cast<std::int64_t>(periods);
}

}  // namespace

struct SensorRecorder::Sensor {
  std::string topic;
  std::string robot;
  std::string frame;
  const sensing::SensorType* type = nullptr;
  sensing::SensorMessages messages;
  std::shared_ptr<const sensing::Sensor> sensor;
  Instants instants;
  int body = -1;                     // index of the robot in layout_; -1 if layout_ lacks the robot
  bool is_wanted = true;             // whether readings are recorded
  bool has_companion = false;        // whether companion messages (such as CameraInfo) are recorded
  bool has_beams = false;            // whether beams are recorded
  std::optional<ChannelId> channel;  // set when the first reading is recorded
  std::optional<ChannelId> companion_channel;  // set when the first reading is recorded
  std::optional<sensing::Reading> newest;      // the newest reading, for sensors with beams
  bool has_failed = false;

  const model::SensorDescription& description() const { return sensor->description(); }
};

SensorRecorder::SensorRecorder(McapWriter& writer,
                               std::shared_ptr<const sensing::SensorRegistry> types,
                               std::uint64_t seed, SensorRecorderOptions options)
    : writer_(writer),
      types_(std::move(types)),
      made_(*types_),
      seed_(seed),
      options_(std::move(options)),
      beams_instants_(base::FromSeconds(1 / options_.rates.beams)),
      beams_(writer, options_.selection, presentation::topics::kBeams),
      transforms_(writer, options_.selection, presentation::topics::kSensorTransforms) {}

SensorRecorder::~SensorRecorder() = default;

void SensorRecorder::SetSensors(const SensorLists& lists, const world::Snapshot& snapshot) {
  Sensors found;
  for (const auto& [robot, list] : lists) {
    for (const model::SensorDescription& description : list) {
      const std::string topic = presentation::SensorTopic(robot, description.name);
      const auto known = sensors_.find(topic);
      if (known != sensors_.end() && known->second->description() == description) {
        found.insert(*known);
      } else if (std::shared_ptr<Sensor> sensor = Make(robot, description)) {
        found.emplace(topic, std::move(sensor));
      }
    }
  }
  if (found == sensors_) return;
  sensors_ = std::move(found);
  in_order_.clear();
  for (const auto& [topic, sensor] : sensors_) in_order_.push_back(sensor.get());
  next_due_ = base::SimTime(0);
  layout_ = nullptr;
  WriteTransforms(snapshot);
}

std::shared_ptr<SensorRecorder::Sensor> SensorRecorder::Make(
    const std::string& robot, const model::SensorDescription& description) {
  const sensing::SensorType* type = types_->Find(description.type);
  if (type == nullptr) return nullptr;
  sensing::SensorMessages sent = type->MessagesOf(description);
  if (sent.schema == nullptr) return nullptr;
  const std::string topic = presentation::SensorTopic(robot, description.name);
  const bool is_wanted = options_.selection.Has(topic);
  const bool has_companion =
      is_wanted && sent.companion &&
      options_.selection.Has(presentation::CompanionTopic(topic, *sent.companion));
  const bool has_beams = beams_.is_wanted() && presentation::HasLines(*type, description);
  if (!is_wanted && !has_beams) return nullptr;
  auto sensor = made_.Of(description);
  if (!sensor) {
    WarnOnce(sensor.error());
    return nullptr;
  }
  if ((*sensor)->TakesLong() && !options_.slow_sensors) return nullptr;
  const double rate = (*sensor)->TakesLong() ? options_.rates.images : options_.rates.readings;
  return std::make_shared<Sensor>(Sensor{.topic = topic,
                                         .robot = robot,
                                         .frame = presentation::FrameOf(robot, description.name),
                                         .type = type,
                                         .messages = std::move(sent),
                                         .sensor = *std::move(sensor),
                                         .instants = Instants(PeriodOf(description, rate)),
                                         .is_wanted = is_wanted,
                                         .has_companion = has_companion,
                                         .has_beams = has_beams});
}

void SensorRecorder::FindBodies(const std::shared_ptr<const world::Layout>& layout) {
  layout_ = layout;
  robot_beams_.assign(layout->bodies.size(), {});
  for (const auto& [topic, sensor] : sensors_) sensor->body = layout->Find(sensor->robot);
}

void SensorRecorder::Record(const std::shared_ptr<const world::Snapshot>& snapshot) {
  if (layout_ != snapshot->layout) FindBodies(snapshot->layout);
  const base::SimTime now = snapshot->state.time;
  if (now < none_due_from_ || now >= next_due_) RecordDue(snapshot);
  if (beams_instants_.AdvanceTo(now) && beams_.is_wanted()) WriteBeams(*snapshot);
}

void SensorRecorder::RecordDue(const std::shared_ptr<const world::Snapshot>& snapshot) {
  none_due_from_ = snapshot->state.time;
  next_due_ = base::SimTime::max();
  sensing::Sampling sampling(snapshot, 0, seed_, rays_);
  std::size_t of_robot = 0;  // number of samples of the present robot in robot_samples_
  std::vector<Sample> slow;
  const auto take_of_robot = [&] {
    if (of_robot > 0) TakeRobotSamples(sampling, std::span(robot_samples_).first(of_robot));
    of_robot = 0;
  };
  const auto take_slow = [&] {
    if (team_ == nullptr) team_ = std::make_unique<base::ThreadTeam>(kSlowAtOnce);
    team_->ParallelFor(slow.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Take({snapshot, slow[i].sensor->body, seed_, rays_}, slow[i]);
      }
    });
    Write(slow);
    slow.clear();
  };
  for (Sensor* const sensor : in_order_) {
    const bool is_due = sensor->instants.AdvanceTo(snapshot->state.time);
    next_due_ = std::min(next_due_, sensor->instants.next());
    if (!is_due || sensor->has_failed) continue;
    if (sensor->body < 0) continue;
    if (sensor->sensor->TakesLong()) {
      slow.push_back({sensor});
      if (slow.size() < kMaxSlowSensors) continue;
      take_of_robot();
      take_slow();
    } else {
      if (of_robot > 0 && robot_samples_[0].sensor->body != sensor->body) take_of_robot();
      if (of_robot == robot_samples_.size()) robot_samples_.emplace_back();
      robot_samples_[of_robot++].sensor = sensor;
    }
  }
  take_of_robot();
  if (!slow.empty()) take_slow();
}

void SensorRecorder::TakeRobotSamples(sensing::Sampling& sampling, std::span<Sample> samples) {
  const int body = samples.front().sensor->body;
  sampling.MoveTo(body);
  due_beams_.clear();
  for (const Sample& sample : samples) {
    if (sample.sensor->sensor->beam() != nullptr) due_beams_.push_back(sample.sensor);
  }
  if (!due_beams_.empty()) {
    RobotBeams& beams = robot_beams_[static_cast<std::size_t>(body)];
    if (beams.sensors != due_beams_) {
      beams = {due_beams_, {}};
      for (const Sensor* sensor : due_beams_) beams.set.Add(*sensor->sensor);
    }
    beam_values_.resize(due_beams_.size());
    beams.set.Sample(sampling, beam_values_);
  }
  auto value = beam_values_.begin();
  for (Sample& sample : samples) {
    if (sample.sensor->sensor->beam() != nullptr) {
      sample.reading = sampling.Stamped();
      sample.reading->values.push_back(*value++);
      Encode(sample);
    } else {
      Take(sampling, sample);
    }
  }
  Write(samples);
}

void SensorRecorder::Take(const sensing::Sampling& sampling, Sample& sample) const {
  sample.reading = sample.sensor->sensor->Sample(sampling);
  if (sample.reading) Encode(sample);
}

void SensorRecorder::Encode(Sample& sample) const {
  const Sensor& sensor = *sample.sensor;
  if (sensor.has_companion) {
    sample.companion = sensor.sensor->EncodeCompanionOf(*sample.reading, sensor.frame);
  }
  if (!sensor.is_wanted) return;
  sample.message.clear();
  if (base::Status status = AppendMessage(sensor, *sample.reading, sample.message); !status) {
    sample.reading = base::Fail(std::move(status.error()));
  }
}

void SensorRecorder::Write(std::span<Sample> samples) {
  messages_.clear();
  for (Sample& sample : samples) {
    if (!AddMessages(sample)) sample.sensor->has_failed = true;
  }
  writer_.Write(messages_);
  for (Sample& sample : samples) {
    if (sample.sensor->has_beams && !sample.sensor->has_failed) {
      sample.sensor->newest = *std::move(sample.reading);
    }
  }
}

bool SensorRecorder::AddMessages(Sample& sample) {
  Sensor& sensor = *sample.sensor;
  if (!sample.reading) {
    WarnOnce(sample.reading.error());
    return false;
  }
  const base::SimTime time = sample.reading->time;
  if (sensor.is_wanted) {
    if (!sensor.channel) sensor.channel = AddChannel(sensor.topic, *sensor.messages.schema);
    if (!sensor.channel) return false;
    messages_.push_back({*sensor.channel, time, sample.message});
  }
  if (sensor.has_companion) {
    const sensing::Companion& type = *sensor.messages.companion;
    if (!sensor.companion_channel) {
      sensor.companion_channel =
          AddChannel(presentation::CompanionTopic(sensor.topic, type), *type.schema);
    }
    sensor.has_companion = sensor.companion_channel.has_value();
    if (!sensor.has_companion) return true;
    messages_.push_back(
        {*sensor.companion_channel, time, std::as_bytes(std::span(sample.companion))});
  }
  return true;
}

std::optional<ChannelId> SensorRecorder::AddChannel(const std::string& topic,
                                                    const messages::Schema& schema) {
  const auto channel = writer_.AddChannel(topic, schema);
  if (channel) return *channel;
  WarnOnce(channel.error());
  return std::nullopt;
}

base::Status SensorRecorder::AppendMessage(const Sensor& sensor, const sensing::Reading& reading,
                                           Bytes& out) const {
  using messages::sensor_msgs::CompressedImage;
  const bool is_image = reading.image != nullptr && options_.write_png &&
                        sensor.messages.schema == &messages::SchemaOf<CompressedImage>();
  if (is_image) {
    if (auto png = options_.write_png(*reading.image)) {
      CompressedImage message;
      message.header = sensing::HeaderOf(reading, sensor.frame);
      message.format = "png";
      message.data = *std::move(png);
      messages::Encode(message, out);
      return {};
    }
  }
  return sensor.sensor->AppendMessage(reading, sensor.frame, out);
}

void SensorRecorder::WriteTransforms(const world::Snapshot& snapshot) {
  messages::tf2_msgs::TFMessage message;
  for (const auto& [topic, sensor] : sensors_) {
    const int body = snapshot.layout->Find(sensor->robot);
    if (body < 0) continue;
    presentation::AppendSensorTransform(*snapshot.layout, body, sensor->description(),
                                        *sensor->type, snapshot.state.time, message);
  }
  transforms_.Write(snapshot.state.time, message);
}

void SensorRecorder::WriteBeams(const world::Snapshot& snapshot) {
  for (const Sensor* const sensor : in_order_) {
    if (!sensor->newest || sensor->body < 0) continue;
    beam_markers_.Add(snapshot, sensor->body, *sensor->type, *sensor->sensor, *sensor->newest);
  }
  const auto message = beam_markers_.Take(snapshot.state.time);
  if (!message.markers.empty()) beams_.Write(snapshot.state.time, message);
}

void SensorRecorder::WarnOnce(const base::Error& error) {
  if (std::exchange(has_warned_, true)) return;
  spdlog::warn("a sensor is not recorded: {}", error.Sentence());
}

}  // namespace gsv::recording
