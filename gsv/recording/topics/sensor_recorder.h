// Records the readings of all sensors on the topics /ROBOT/SENSOR, their beams on one topic, and
// their transforms (/tf_static).
//
// A reading is a function of the snapshot. So the recorder samples the sensor a second time: it
// gets the same reading as the robot's behaviour, and the simulation does not change.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/visualization_msgs.h"
#include "gsv/presentation/sensor_messages.h"
#include "gsv/recording/topics/instants.h"
#include "gsv/recording/topics/simulation_feed.h"
#include "gsv/recording/topics/topic_writer.h"
#include "gsv/sensing/beam_set.h"
#include "gsv/sensing/sensor_set.h"

namespace gsv::recording {

// Rates in Hz of simulated time, > 0. If a sensor is faster, only every n-th of its readings is
// recorded.
struct SensorRates {
  double readings = 20;
  double images = 1;
  double beams = 10;
};

// Encodes an image as PNG.
using WritePng = std::function<base::Result<std::vector<std::uint8_t>>(const model::Image& image)>;

struct SensorRecorderOptions {
  SensorRates rates{};
  Selection selection{};  // the selected topics
  // Encodes images of cameras as PNG. If empty, these images are recorded as JPEG, as the sensors
  // encode them.
  WritePng write_png{};
  bool slow_sensors = true;  // whether to record sensors whose readings take long, such as cameras
};

class SensorRecorder {
 public:
  // `writer` must outlive this object. `seed` is the seed of the simulation.
  SensorRecorder(McapWriter& writer, std::shared_ptr<const sensing::SensorRegistry> types,
                 std::uint64_t seed, SensorRecorderOptions options);
  ~SensorRecorder();

  // Sets the sensors that are recorded from now on.
  void SetSensors(const SensorLists& lists, const world::Snapshot& snapshot);
  // Writes the readings and beams that are due at the snapshot's time. Several images are rendered
  // at the same time.
  void Record(const std::shared_ptr<const world::Snapshot>& snapshot);

 private:
  // A sensor with its channels and the instants of its readings.
  struct Sensor;
  // Writes the readings that are due, and sets the time at which the next ones are due.
  void RecordDue(const std::shared_ptr<const world::Snapshot>& snapshot);
  // A due reading of one sensor, with its encoded messages.
  struct Sample {
    Sensor* sensor = nullptr;
    base::Result<sensing::Reading> reading{};  // the reading, or why it could not be taken
    Bytes message{};                           // empty if only the sensor's beams are recorded
    // A message such as CameraInfo; empty if there is none.
    std::vector<std::uint8_t> companion{};
  };
  // The sensors with beams of one robot that were last sampled together. A new set is made only if
  // the next sample is of different sensors.
  struct RobotBeams {
    std::vector<const Sensor*> sensors;
    sensing::BeamSet set;  // the beams of `sensors`
  };
  using Sensors = std::map<std::string, std::shared_ptr<Sensor>>;  // sensors by topic

  std::shared_ptr<Sensor> Make(const std::string& robot,
                               const model::SensorDescription& description);
  // Takes the sample's reading, and encodes it.
  void Take(const sensing::Sampling& sampling, Sample& sample) const;
  void Encode(Sample& sample) const;
  // Takes and writes the samples of one robot. The beams of the robot are cast together.
  void TakeRobotSamples(sensing::Sampling& sampling, std::span<Sample> samples);
  // Updates the body index of each sensor for this layout.
  void FindBodies(const std::shared_ptr<const world::Layout>& layout);
  // Writes the messages of the samples. If a sensor has beams, keeps its reading for WriteBeams().
  void Write(std::span<Sample> samples);
  // Adds the messages of a sample to messages_. Returns false if the sensor cannot be recorded.
  bool AddMessages(Sample& sample);
  // Adds a channel. On failure, logs a warning and returns nullopt.
  std::optional<ChannelId> AddChannel(const std::string& topic, const messages::Schema& schema);
  // Appends the message of a reading to `out`.
  base::Status AppendMessage(const Sensor& sensor, const sensing::Reading& reading,
                             Bytes& out) const;
  void WriteTransforms(const world::Snapshot& snapshot);
  void WriteBeams(const world::Snapshot& snapshot);
  // Logs a warning for the first sensor that cannot be recorded. Further ones are not logged,
  // because there may be thousands.
  void WarnOnce(const base::Error& error);

  McapWriter& writer_;
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  sensing::SensorSet made_;  // sensors that were created from types_
  const std::uint64_t seed_;
  const SensorRecorderOptions options_;
  sensing::RaySceneCache rays_;
  std::unique_ptr<base::ThreadTeam> team_;  // samples slow sensors; null if there are none
  Sensors sensors_;                         // the recorded sensors, by topic
  std::vector<Sensor*> in_order_;           // the sensors in sensors_, in the same order
  // No reading is due at times t with none_due_from_ <= t < next_due_.
  base::SimTime none_due_from_{0}, next_due_{0};
  // The layout whose body indices Sensor::body and robot_beams_ use; null after SetSensors().
  std::shared_ptr<const world::Layout> layout_;
  std::vector<RobotBeams> robot_beams_;  // by body
  // Working memory of RecordDue(): the samples of one robot, the sensors of these samples that have
  // a beam, and the values that these beams return.
  std::vector<Sample> robot_samples_;
  std::vector<const Sensor*> due_beams_;
  std::vector<double> beam_values_;
  std::vector<McapWriter::Message> messages_;  // working memory of Write()
  Instants beams_instants_;                    // instants at which beams are recorded
  presentation::BeamMarkers beam_markers_;
  bool has_warned_ = false;  // whether WarnOnce() has logged a warning

  TopicWriter<messages::visualization_msgs::MarkerArray> beams_;
  TopicWriter<messages::tf2_msgs::TFMessage> transforms_;
};

}  // namespace gsv::recording
