// A ReplayStream publishes the messages of a recording to a hub as the replay's time advances.
//
// Publish() sends the newest message of each topic. PlayTo() sends every message of the topics with
// presentation::Replay::kEach, such as /gsv/events. After a seek, earlier ones are not sent. /clock
// and /gsv/status are made from the replay's own time and status.
//
// Threads  JumpTo(), PlayTo() and Publish() from one thread; the other functions from any.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/foxglove/hub.h"
#include "gsv/gateway/live/pacing.h"
#include "gsv/gateway/live/wanted_robots.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/simulation/types.h"

namespace gsv::gateway {

// Publishes the messages of a recording to a hub.
class ReplayStream {
 public:
  // Advertises the topics of the recording, at most kMaxSensorTopics. `reader` must outlive this.
  // `on_demand` and `operations`: see Hub.
  ReplayStream(const recording::McapReader& reader, const std::string& name,
               std::function<void()> on_demand, std::shared_ptr<Operations> operations);

  const std::shared_ptr<Hub>& hub() const { return hub_; }

  // Requests the sensors of a robot. The next Publish() advertises them even beyond the limit.
  void Want(const std::string& robot) { wanted_.Want(robot); }

  // Reads the newest message of each topic that is not after `time`.
  void JumpTo(base::SimTime time);
  // Reads the messages from the present position to `time`, inclusive.
  void PlayTo(base::SimTime time);
  // Publishes the messages since the last call, and the current state to new subscribers. Calls
  // `status` only if it is needed.
  void Publish(base::SimTime time, simulation::Phase phase, WallTime now,
               const std::function<simulation::SimulationStatus()>& status);

  // These functions return the last recorded status and poses; empty before the first message.
  messages::gsv_msgs::SimulationStatus recorded_status() const;
  messages::gsv_msgs::Poses recorded_poses() const;

 private:
  // How the messages of a topic are published. kPlain and kPoses: only the newest message. kEvents:
  // every message. kStatus and kClock: not at all, because the replay makes its own messages.
  enum class Kind { kPlain, kEvents, kStatus, kClock, kPoses };
  // How a channel of the recording is published, and its newest message.
  struct Track {
    Kind kind = Kind::kPlain;
    foxglove::ChannelId channel = 0;     // 0 if the track is not published
    bool is_wanted = false;              // true if it is advertised because its robot was requested
    std::optional<Hub::Message> latest;  // the newest message; nullopt before the first one
    bool is_fresh = false;               // whether `latest` was not published yet
  };

  // Returns how the messages of a topic are published.
  static Kind KindOf(const std::string& topic);
  // Advertises the topics up to the limit, beginning with the topics of the whole simulation.
  void AdvertiseFirst();
  // Advertises the sensor topics of robots that were requested since the last call.
  void AdvertiseWanted();
  // If too many robots are requested, withdraws the topics of robots without subscribers.
  void EvictUnsubscribed();
  // Returns the robots whose topics have subscribers.
  std::set<std::string> SubscribedRobots() const;
  // Returns the topic of a channel of the recording.
  const std::string& TopicOf(std::uint16_t id) const;
  // Advertises these channels of the recording.
  void Advertise(const std::vector<std::uint16_t>& ids);
  // Stores the message as the newest of its track, and returns the track. Returns null if the
  // channel is not replayed.
  const Track* Keep(std::uint16_t id, base::SimTime time, recording::Bytes data);
  // Reads the next message of cursor_ into next_. Skips damaged parts with a warning.
  void ReadNext();
  // Publishes the newest message of a track.
  void Publish(Track& track);
  // Publishes a message that is not recorded: to all subscribers if it is due, else only to new
  // subscribers.
  void PublishOwn(foxglove::ChannelId channel, bool is_due, base::SimTime time,
                  const std::function<SharedBytes()>& encode);
  // Sends a warning to all clients, until the maximum number of warnings is reached.
  void Warn(const std::string& sentence);

  const recording::McapReader& reader_;
  const std::shared_ptr<Hub> hub_;
  foxglove::ChannelId clock_channel_ = 0, status_channel_ = 0;  // /clock and /gsv/status; 0: none
  std::map<std::uint16_t, Track> tracks_;                       // by channel of the recording
  WantedRobots wanted_;  // robots whose topics were requested and are replayed too
  std::optional<recording::MessageCursor> cursor_;  // position in the recording
  std::optional<recording::MessageRecord> next_;    // the next message of cursor_
  std::optional<base::SimTime> published_time_;     // the time and phase that were published last
  std::optional<simulation::Phase> published_phase_;
  Pacing status_pacing_;
  bool has_jumped_ = false;  // whether there was a jump since the last Publish()
  int warnings_ = 0;         // number of warnings so far, which is limited

  mutable base::Mutex mutex_;
  SharedBytes status_ GSV_GUARDED_BY(mutex_);  // the status as it was recorded
  SharedBytes poses_ GSV_GUARDED_BY(mutex_);   // the poses as they were recorded
};

}  // namespace gsv::gateway
