// The messages of a recording, published to a hub as its time goes by.
//
// Of each topic a round publishes the newest message, of /gsv/events every one that it comes past:
// a jump tells no old events as news. /clock and /gsv/status are the replay's own.
//
// Threads  JumpTo(), PlayTo() and Publish() come from one thread; the others from any.
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

class ReplayStream {
 public:
  // Advertises what the recording holds, as much as of a simulation (SensorTopics). `reader` must
  // outlive this; `on_demand` and `operations`: see Hub.
  ReplayStream(const recording::McapReader& reader, const std::string& name,
               std::function<void()> on_demand, std::shared_ptr<Operations> operations);

  const std::shared_ptr<Hub>& hub() const { return hub_; }

  // Somebody wants to listen to this robot's sensors: they will be advertised, however many others
  // there are, at the next Publish().
  void Want(const std::string& robot) { wanted_.Want(robot); }

  // Takes each topic's newest message that is not after `time`.
  void JumpTo(base::SimTime time);
  // Takes what comes from where it stands up to `time`, included.
  void PlayTo(base::SimTime time);
  // Sends what was taken since the last call, and to newcomers how things stand. `status` is asked
  // when it is needed.
  void Publish(base::SimTime time, simulation::Phase phase, WallTime now,
               const std::function<simulation::SimulationStatus()>& status);

  // What the recording said last of the robots, and of where they are; empty: nothing yet.
  messages::gsv_msgs::SimulationStatus recorded_status() const;
  messages::gsv_msgs::Poses recorded_poses() const;

 private:
  enum class Kind { kPlain, kEvents, kStatus, kClock, kPoses };
  struct Track {
    Kind kind = Kind::kPlain;
    foxglove::ChannelId channel = 0;  // 0: not published
    bool is_wanted = false;           // it is published because somebody wanted the robot's
    std::optional<Hub::Message> latest;
    bool is_fresh = false;
  };

  static Kind KindOf(const std::string& topic);
  void AdvertiseFirst();
  void AdvertiseWanted();
  void EvictUnheard();
  std::set<std::string> RobotsHeard() const;
  const std::string& TopicOf(std::uint16_t id) const;
  void Advertise(const std::vector<std::uint16_t>& ids);
  // The message's track, of which it is the latest now; null: a channel that is not replayed.
  const Track* Keep(std::uint16_t id, base::SimTime time, recording::Bytes data);
  void ReadNext();
  void Publish(Track& track);
  void PublishOwn(foxglove::ChannelId channel, bool is_due, base::SimTime time,
                  const std::function<SharedBytes()>& encode);
  void Warn(const std::string& sentence);

  const recording::McapReader& reader_;
  const std::shared_ptr<Hub> hub_;
  foxglove::ChannelId clock_channel_ = 0, status_channel_ = 0;
  std::map<std::uint16_t, Track> tracks_;
  WantedRobots wanted_;
  std::optional<recording::MessageCursor> cursor_;
  std::optional<recording::MessageRecord> next_;  // of cursor_
  std::optional<base::SimTime> published_time_;
  std::optional<simulation::Phase> published_phase_;
  Pacing status_pacing_;
  bool has_jumped_ = false;  // since the last Publish()
  int warnings_ = 0;

  mutable base::Mutex mutex_;
  SharedBytes status_ GSV_GUARDED_BY(mutex_);  // as recorded
  SharedBytes poses_ GSV_GUARDED_BY(mutex_);   // as recorded
};

}  // namespace gsv::gateway
