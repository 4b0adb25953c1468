// The readings of all sensors, each on its topic /ROBOT/SENSOR, their beams in one, and where the
// sensors sit (/tf_static).
//
// A reading is a function of the snapshot, so it is sampled here again: the same value that the
// robot's behaviour gets, without leaving a trace in the simulation.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/messages/visualization_msgs.h"
#include "gsv/presentation/sensor_messages.h"
#include "gsv/recording/topics/instants.h"
#include "gsv/recording/topics/simulation_feed.h"
#include "gsv/recording/topics/topic_writer.h"
#include "gsv/sensing/sensor_set.h"

namespace gsv::recording {

// Hz of simulated time, > 0. A sensor that samples faster is recorded at every n-th of its
// instants.
struct SensorRates {
  double readings = 20;
  double pictures = 1;
  double beams = 10;
};

// A picture as PNG.
using WritePng =
    std::function<base::Result<std::vector<std::uint8_t>>(const model::Image& picture)>;

struct SensorRecorderOptions {
  SensorRates rates{};
  Selection selection{};  // of topics
  // For the pictures that their sensors send as JPEG; without it they are recorded so.
  WritePng write_png{};
};

class SensorRecorder {
 public:
  // `writer` must outlive this. `seed` is the simulation's.
  SensorRecorder(McapWriter& writer, std::shared_ptr<const sensing::SensorRegistry> types,
                 std::uint64_t seed, SensorRecorderOptions options);
  ~SensorRecorder();

  // These are the sensors from here on.
  void Mount(const SensorLists& lists, const world::Snapshot& snapshot);
  // Writes what is due at the snapshot's time; pictures are waited for all at once.
  void Record(const std::shared_ptr<const world::Snapshot>& snapshot);

 private:
  struct Sensor;
  struct Sample {
    const std::string* topic = nullptr;  // the key in sensors_
    Sensor* sensor = nullptr;
    int body = 0;
    base::Result<sensing::Reading> reading;
    std::vector<std::uint8_t> message;    // empty if only its beams are wanted
    std::vector<std::uint8_t> companion;  // empty where there is none
  };
  using Sensors = std::map<std::string, std::shared_ptr<Sensor>>;  // by topic

  std::shared_ptr<Sensor> Make(const std::string& robot,
                               const model::SensorDescription& description);
  void Take(const std::shared_ptr<const world::Snapshot>& snapshot, Sample& sample);
  void Write(Sample& sample);
  // Nothing, and a complaint, if it cannot be had.
  std::optional<ChannelId> AddChannel(const std::string& topic, const messages::Schema& schema);
  base::Result<std::vector<std::uint8_t>> Encode(const Sensor& sensor,
                                                 const sensing::Reading& reading) const;
  void WriteTransforms(const world::Snapshot& snapshot);
  void WriteBeams(const world::Snapshot& snapshot);
  // Of all sensors that cannot be recorded only the first is told of: there may be thousands.
  void Complain(const base::Error& error);

  McapWriter& writer_;
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  sensing::SensorSet made_;  // of types_
  const std::uint64_t seed_;
  const SensorRecorderOptions options_;
  sensing::RaySceneCache rays_;
  std::unique_ptr<base::ThreadTeam> team_;  // for sensors that take long, once there is one
  Sensors sensors_;
  Instants beams_instants_;
  presentation::BeamMarkers beam_markers_;
  bool has_complained_ = false;

  TopicWriter<messages::visualization_msgs::MarkerArray> beams_;
  TopicWriter<messages::tf2_msgs::TFMessage> transforms_;
};

}  // namespace gsv::recording
