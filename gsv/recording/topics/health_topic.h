// Records /gsv/health every 10 s, and at each change (checked every 0.5 s of simulated time).
//
// Readings are functions of the snapshot, so they are sampled here, without an effect on the
// simulation.
#pragma once

#include <memory>
#include <optional>

#include "gsv/health/health_tracker.h"
#include "gsv/recording/topics/instants.h"
#include "gsv/recording/topics/simulation_feed.h"
#include "gsv/recording/topics/topic_writer.h"
#include "gsv/sensing/sensor_set.h"

namespace gsv::recording {

// Writes the topic /gsv/health of a recording.
class HealthTopic {
 public:
  // `writer` must outlive this object. `seed` and `stuck_after` are values of the simulation.
  HealthTopic(McapWriter& writer, const Selection& selection,
              std::shared_ptr<const sensing::SensorRegistry> types, std::uint64_t seed,
              base::SimTime stuck_after);

  // Sets the robots' sensors from now on.
  void SetSensors(std::shared_ptr<const SensorLists> lists) { lists_ = std::move(lists); }
  // Writes the messages that are due. `status` is the status at the snapshot.
  void Record(const std::shared_ptr<const world::Snapshot>& snapshot,
              const simulation::SimulationStatus& status);

 private:
  // Samples a sensor, for the tracker.
  base::Result<sensing::Reading> Read(const std::shared_ptr<const world::Snapshot>& snapshot,
                                      const std::string& robot, const std::string& sensor);

  TopicWriter<messages::gsv_msgs::Health> topic_;
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  const std::uint64_t seed_;
  const base::SimTime stuck_after_;  // Specification::stuck_after
  // Sensors that were created from types_.
  sensing::SensorSet made_;
  std::map<std::string, std::shared_ptr<const sensing::Sensor>> sensors_;  // by "robot/sensor"
  sensing::RaySceneCache rays_;
  std::shared_ptr<const SensorLists> lists_;  // the argument of SetSensors()
  Instants instants_;                         // instants at which changes are checked
  health::HealthTracker tracker_;
  // The last written message, and its time.
  std::optional<messages::gsv_msgs::Health> written_;
  base::SimTime written_at_{0};
};

}  // namespace gsv::recording
