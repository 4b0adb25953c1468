// SensorTopics publishes the live topics of sensors, and the topic of all beams. Sensors are read
// only if there are subscribers.
//
// A reading may be slow (an image), so worker threads read the sensors: at most one reading per
// topic at a time.
//
// Threads  Refresh() and Publish() from one thread, Want() from any. Jobs of workers keep this
//          object alive.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/pacing.h"
#include "gsv/gateway/live/robot_beams.h"
#include "gsv/gateway/live/wanted_robots.h"
#include "gsv/gateway/server/worker_pool.h"
#include "gsv/presentation/sensor_messages.h"
#include "gsv/sensing/sensor_set.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// A thousand robots have more topics than a viewer can list. The stream advertises about this many
// topics of sensors, and the topics of requested robots (WantedRobots). A status message reports
// that other sensors have no topic.
inline constexpr std::size_t kMaxSensorTopics = 2000;

// Publishes the live topics of sensors.
class SensorTopics : public std::enable_shared_from_this<SensorTopics> {
 public:
  // `workers` must outlive the last Publish().
  SensorTopics(std::shared_ptr<Hub> hub, WorkerPool& workers);

  // Requests the sensors of a robot. The next Refresh() advertises them even beyond
  // kMaxSensorTopics.
  void Want(const std::string& robot) { wanted_.Want(robot); }
  // Whether sensors were requested since the last Refresh().
  bool has_requests() const { return wanted_.has_requests(); }

  // Lists the current sensors; advertises and withdraws their topics.
  void Refresh(simulation::Simulation& simulation, const world::Snapshot& snapshot);

  // Starts to read the sensors that have subscribers and are due.
  void Publish(const std::shared_ptr<simulation::Simulation>& simulation,
               const std::shared_ptr<const world::Snapshot>& snapshot, WallTime now);

 private:
  // A sensor with its topics, and the state of its readings.
  struct Sensor;
  using Sensors = std::map<std::string, std::shared_ptr<Sensor>>;  // by topic
  using SensorList = std::vector<std::shared_ptr<Sensor>>;

  // Returns the sensors that exist now, by topic.
  Sensors ListSensors(simulation::Simulation& simulation, const world::Layout& layout);
  // Withdraws the topics of sensors that are not in `found`.
  void Withdraw(const Sensors& found);
  // Returns the beam sensors of the requested robots.
  RobotBeams::Sources WantedBeams() const;
  // If too many robots are requested, withdraws the topics of robots without subscribers.
  void EvictUnsubscribed(Sensors& found);
  // Returns the robots whose topics have subscribers.
  std::set<std::string> SubscribedRobots() const;
  // Advertises the topics of sensors without a channel, up to kMaxSensorTopics. Sensors of
  // requested robots are advertised even beyond this limit.
  void Advertise(Sensors& found);

  // Publishes the static transforms of the sensors.
  void PublishTransforms(const world::Snapshot& snapshot);
  // Sends the message of a sensor's companion topic to the new subscribers of that topic. A
  // companion topic describes the readings, as camera_info describes images.
  void SendCompanion(const world::Snapshot& snapshot, const Sensor& sensor);
  // Returns whether there are new subscribers to the sensor's readings.
  bool HasNewSubscribers(const Sensor& sensor) const;
  // Starts to read a sensor on a worker thread, if it is due.
  void PublishReading(const std::shared_ptr<simulation::Simulation>& simulation,
                      const world::Snapshot& snapshot, WallTime now,
                      const std::shared_ptr<Sensor>& sensor);
  // Starts to read all beam sensors on a worker thread, if they are due.
  void PublishBeams(const std::shared_ptr<simulation::Simulation>& simulation,
                    const std::shared_ptr<const world::Snapshot>& snapshot, WallTime now);
  // Reads a sensor and publishes its messages, on a worker thread.
  void ReadSensor(simulation::Simulation& simulation, Sensor& sensor);
  // Reads the beam sensors and publishes their beams, on a worker thread.
  void ReadBeams(simulation::Simulation& simulation, const world::Snapshot& snapshot,
                 const SensorList& sensors);

  const std::shared_ptr<Hub> hub_;
  WorkerPool& workers_;
  // The topic of all beams, and the topic of the sensors' transforms.
  foxglove::ChannelId beams_channel_ = 0, transforms_channel_ = 0;
  std::optional<sensing::SensorSet> made_;  // set by the first Refresh()
  Sensors sensors_;
  std::map<foxglove::ChannelId, std::shared_ptr<Sensor>> by_channel_;  // sensors_, by channel
  std::size_t topics_ = 0;          // number of channels of sensors that were not requested
  bool limit_reported_ = false;     // whether the status message about kMaxSensorTopics was sent
  WantedRobots wanted_;             // robots whose topics were requested
  bool transforms_changed_ = true;  // whether the sensors' transforms must be published again
  std::shared_ptr<const SensorList> beam_sensors_;  // the sensors with beams
  Pacing beams_pacing_;
  std::weak_ptr<const world::Snapshot> beams_of_;  // the snapshot whose beams were read last
  std::atomic<bool> beams_busy_{false};            // whether a worker thread reads the beams now
  presentation::BeamMarkers beam_markers_;         // used only by the job that reads the beams
  RobotBeams robot_beams_;
};

}  // namespace gsv::gateway
