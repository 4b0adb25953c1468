#include "gsv/gateway/live/command_topic.h"

#include <utility>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/presentation/state_messages.h"

namespace gsv::gateway {
namespace {

// Maximum number of messages per call of Publish(). This limit leaves space for other data in a
// viewer's queue, even with a crowd of robots.
constexpr int kMaxPerRound = 64;

}  // namespace

CommandTopic::CommandTopic(std::shared_ptr<Hub> hub)
    : hub_(std::move(hub)),
      channel_(hub_->Advertise({ChannelFor(presentation::topics::kCommands)}).front()) {}

void CommandTopic::Publish(const world::Snapshot& snapshot) {
  if (snapshot.layout != layout_) FollowLayout(snapshot);
  if (!hub_->IsSubscribed(channel_)) return;
  if (hub_->HasNewSubscribers(channel_)) {
    hub_->Welcome(channel_, {});
    sent_.assign(sent_.size(), {});
  }
  int sent = 0;
  for (std::size_t i = 0; i < sent_.size() && sent < kMaxPerRound; ++i) {
    const std::size_t body = std::exchange(next_, (next_ + 1) % sent_.size());
    const world::DriveState& drive = snapshot.state.bodies[body].drive;
    world::DriveState& last = sent_[body];
    const bool is_news = drive.command != last.command || drive.command_time != last.command_time;
    if (!layout_->bodies[body].is_robot() || !is_news) continue;
    last = drive;
    ++sent;
    hub_->Publish(
        channel_,
        {base::NanosecondsOf(snapshot.state.time),
         Encoded(presentation::CommandMessage(layout_->bodies[body].name, drive, snapshot.state))});
  }
}

void CommandTopic::FollowLayout(const world::Snapshot& snapshot) {
  layout_ = snapshot.layout;
  sent_.assign(layout_->bodies.size(), {});
  next_ = 0;
  std::set<std::string> robots;
  for (const world::Body& body : layout_->bodies) {
    if (body.is_robot()) robots.insert(body.name);
  }
  hub_->SetPublishers(channel_, std::move(robots));
}

}  // namespace gsv::gateway
