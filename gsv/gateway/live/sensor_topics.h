// The sensors' own topics, and all beams in one: readings taken for those who watch.
//
// A reading may take long (a picture), so it is taken on a worker thread; of each topic at most one
// is under way.
//
// Threads  Refresh() and Publish() come from one thread, Want() from any; the workers' jobs keep
//          this object alive.
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
#include "gsv/gateway/live/wanted_robots.h"
#include "gsv/gateway/server/worker_pool.h"
#include "gsv/presentation/sensor_messages.h"
#include "gsv/sensing/sensor_set.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// A robot has more topics than a viewer can list when there are a thousand robots: those of the
// first so many sensors are advertised, besides those of the robots that somebody wants to listen
// to (WantedRobots), and a status message says that it is not all.
inline constexpr std::size_t kMaxSensorTopics = 2000;

class SensorTopics : public std::enable_shared_from_this<SensorTopics> {
 public:
  // `workers` outlives this object's last Publish().
  SensorTopics(std::shared_ptr<Hub> hub, WorkerPool& workers);

  // Somebody wants to listen to this robot's sensors: they will be advertised, however many others
  // there are, at the next Refresh().
  void Want(const std::string& robot) { wanted_.Want(robot); }
  bool has_requests() const { return wanted_.has_requests(); }

  // Looks which sensors there are now; advertises and withdraws their topics.
  void Refresh(simulation::Simulation& simulation, const world::Snapshot& snapshot);

  // Has the readings taken that somebody waits for and that are due.
  void Publish(const std::shared_ptr<simulation::Simulation>& simulation,
               const std::shared_ptr<const world::Snapshot>& snapshot, WallTime now);

 private:
  struct Sensor;
  using Sensors = std::map<std::string, std::shared_ptr<Sensor>>;  // by topic
  using SensorList = std::vector<std::shared_ptr<Sensor>>;

  Sensors Found(simulation::Simulation& simulation, const world::Layout& layout);
  void Withdraw(const Sensors& found);
  void EvictUnheard(Sensors& found);
  std::set<std::string> RobotsHeard() const;
  void Advertise(Sensors& found);

  void PublishTransforms(const world::Snapshot& snapshot);
  void SendCompanion(const world::Snapshot& snapshot, const Sensor& sensor);
  // Somebody has subscribed to its readings since they were last sent.
  bool HasNewSubscribers(const Sensor& sensor) const;
  void PublishReading(const std::shared_ptr<simulation::Simulation>& simulation,
                      const world::Snapshot& snapshot, WallTime now,
                      const std::shared_ptr<Sensor>& sensor);
  void PublishBeams(const std::shared_ptr<simulation::Simulation>& simulation,
                    const std::shared_ptr<const world::Snapshot>& snapshot, WallTime now);
  // On a worker.
  void TakeReading(simulation::Simulation& simulation, Sensor& sensor);
  void TakeBeams(simulation::Simulation& simulation, const world::Snapshot& snapshot,
                 const SensorList& sensors);

  const std::shared_ptr<Hub> hub_;
  WorkerPool& workers_;
  foxglove::ChannelId beams_channel_ = 0, transforms_channel_ = 0;
  std::optional<sensing::SensorSet> made_;  // once there is a simulation
  Sensors sensors_;
  std::map<foxglove::ChannelId, std::shared_ptr<Sensor>> by_channel_;
  std::size_t topics_ = 0;  // how many of them have a channel without having been wanted
  bool limit_reported_ = false;
  WantedRobots wanted_;
  bool transforms_changed_ = true;
  std::shared_ptr<const SensorList> beam_sensors_;
  Pacing beams_pacing_;
  std::weak_ptr<const world::Snapshot> beams_of_;  // the last that beams were taken for
  std::atomic<bool> beams_busy_{false};
  presentation::BeamMarkers beam_markers_;  // used by the beams' job alone
};

}  // namespace gsv::gateway
