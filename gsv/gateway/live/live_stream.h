// A LiveStream polls one simulation and publishes its changes to a hub.
//
// Threads  Round() from the publisher's thread; the other functions from any.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/gateway/access/viewers_topic.h"
#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/command_topic.h"
#include "gsv/gateway/live/event_topics.h"
#include "gsv/gateway/live/health_topics.h"
#include "gsv/gateway/live/pacing.h"
#include "gsv/gateway/live/sensor_topics.h"
#include "gsv/gateway/live/status_topics.h"
#include "gsv/gateway/live/step_cost_topic.h"
#include "gsv/gateway/live/step_event_topic.h"
#include "gsv/gateway/program/ports.h"
#include "gsv/presentation/pose_list.h"

namespace gsv::gateway {

// The rates of packed poses and of contacts, in Hz of wall-clock time. If there are many bodies or
// contacts, the limit of bytes per second reduces the rate, but not below the lowest rate.
inline constexpr double kPackedPosesRate = 20;
inline constexpr double kMinPackedPosesRate = 8;
inline constexpr double kContactsRate = 15;
inline constexpr double kMinContactsRate = 2;
inline constexpr double kMaxSnapshotBytesPerSecond = 350'000;

// The rate at which Round() is called for a stream with clients, and the highest rate of poses. In
// Hz of wall-clock time.
inline constexpr double kPublishRate = 30;

// Publishes the changes of one simulation to a hub.
class LiveStream {
 public:
  // Keeps the simulation alive only during Round() and while sensors are read. `on_demand`: see
  // Hub. Sensors are read on `watchers`, commands run on `commanders`. `recordings` may be null:
  // then viewers cannot record. `registry`: see ViewersTopic.
  LiveStream(const std::shared_ptr<simulation::Simulation>& simulation, WorkerPool& watchers,
             WorkerPool& commanders, RecordingSwitch* recordings, std::function<void()> on_demand,
             access::ViewerRegistry* registry = nullptr);

  const std::shared_ptr<Hub>& hub() const { return hub_; }

  // Requests the topics of a robot's sensors, see SensorTopics::Want(). Any thread may call this.
  void WantSensorsOf(const std::string& robot) { sensors_->Want(robot); }

  // Publishes the messages that are due. Encodes only topics that have subscribers.
  void Round(const std::shared_ptr<simulation::Simulation>& simulation, WallTime now);

 private:
  using SnapshotPointer = std::shared_ptr<const world::Snapshot>;

  // A channel whose messages are encoded from the latest snapshot.
  struct SnapshotTopic {
    foxglove::ChannelId channel = 0;
    // Returns the message for a snapshot.
    SharedBytes (LiveStream::*encode)(const world::Snapshot&) const = nullptr;
    double rate = kPublishRate;  // Hz
    // The limit of bytes per second does not reduce the rate below this value, in Hz.
    double min_rate = kPublishRate;
    Pacing pacing{rate};                             // limits the rate of the topic's messages
    std::weak_ptr<const world::Snapshot> published;  // the snapshot of the last message
    Hub::Message latest;                             // the last message, for new subscribers
  };

  // Updates the list of poses after a change of the layout, and the topics of sensors when due.
  void FollowLayout(simulation::Simulation& simulation, const world::Snapshot& snapshot,
                    WallTime now);
  // Publishes the simulated time of a new snapshot.
  void PublishTime(const SnapshotPointer& snapshot);
  // Returns the rate of the topic in Hz, which depends on the size of its last message.
  static double RateFor(const SnapshotTopic& topic);
  // Publishes a topic if the snapshot is new and the topic is due.
  void Publish(SnapshotTopic& topic, const SnapshotPointer& snapshot, WallTime now);

  SharedBytes EncodeClock(const world::Snapshot& snapshot) const;
  SharedBytes EncodePoses(const world::Snapshot& snapshot) const;
  SharedBytes EncodePackedPoses(const world::Snapshot& snapshot) const;
  SharedBytes EncodeTransforms(const world::Snapshot& snapshot) const;
  SharedBytes EncodeContacts(const world::Snapshot& snapshot) const;

  const std::shared_ptr<Hub> hub_;
  std::vector<SnapshotTopic> snapshot_topics_;

  StatusTopics status_;
  EventTopics events_;
  HealthTopics health_;

  std::shared_ptr<const world::Layout> layout_;     // the layout of the last snapshot
  std::vector<presentation::PoseEntry> pose_list_;  // PoseListOf() for layout_
  Pacing refresh_pacing_;  // limits how often the topics of sensors are listed
  std::weak_ptr<const world::Snapshot> time_of_;  // the last snapshot whose time was published
  CommandTopic commands_;
  ContactTopic contacts_;
  RadioTopic radio_;
  StepCostTopic step_costs_;
  access::ViewersTopic viewers_;
  std::shared_ptr<SensorTopics> sensors_;
};

}  // namespace gsv::gateway
