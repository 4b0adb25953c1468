// A StepEventTopic is a live topic of events at single steps, such as contacts. Each event has a
// message with the time of its step.
//
// Publish() is called less often than the simulation steps. So, while there are subscribers, the
// stepping thread collects the events of each step.
//
// Bounded  only the newest events since the last Publish() are kept.
// Threads  Publish() from one thread.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/foxglove/channels.h"
#include "gsv/gateway/foxglove/hub.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

template <typename Message>
class StepEventTopic {
 public:
  // Appends the events of a snapshot. It runs on the stepping thread and must be fast.
  using Collect = std::function<void(const world::Snapshot& snapshot, std::vector<Message>& found)>;

  // Advertises the topic.
  StepEventTopic(std::shared_ptr<Hub> hub, const presentation::TopicOf<Message>& topic,
                 Collect collect)
      : hub_(std::move(hub)),
        channel_(hub_->Advertise({ChannelFor(topic)}).front()),
        collect_(std::move(collect)) {}

  // Publishes the events since the last call, if there are subscribers.
  void Publish(simulation::Simulation& simulation) {
    if (!hub_->IsSubscribed(channel_)) {
      if (watch_) simulation.RemoveObserver(std::exchange(watch_, nullptr));
      return;
    }
    if (!watch_) {
      watch_ = std::make_shared<Watch>(collect_);
      simulation.AddObserver(watch_);
    }
    if (hub_->HasNewSubscribers(channel_)) hub_->Welcome(channel_, {});
    for (const auto& [time, message] : watch_->Take()) {
      hub_->Publish(channel_, {base::NanosecondsOf(time), Encoded(message)});
    }
  }

 private:
  // Maximum number of messages per Publish(). This limit leaves space for other data in viewers'
  // queues.
  static constexpr std::size_t kMaxMoments = 64;

  // Collects the events on the stepping thread.
  class Watch final : public simulation::Observer {
   public:
    using Moment = std::pair<base::SimTime, Message>;  // an event, and the time of its step

    explicit Watch(Collect collect) : collect_(std::move(collect)) {}

    void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override {
      std::vector<Message> found;
      collect_(*snapshot, found);
      if (found.empty()) return;
      const base::MutexLock lock(mutex_);
      for (Message& message : found) {
        if (moments_.size() == kMaxMoments) moments_.pop_front();
        moments_.emplace_back(snapshot->state.time, std::move(message));
      }
    }
    void OnEvent(const simulation::Event&) override {}

    // Returns the collected events, and removes them.
    std::deque<Moment> Take() {
      const base::MutexLock lock(mutex_);
      return std::exchange(moments_, {});
    }

   private:
    const Collect collect_;
    base::Mutex mutex_;
    std::deque<Moment> moments_ GSV_GUARDED_BY(mutex_);
  };

  const std::shared_ptr<Hub> hub_;
  foxglove::ChannelId channel_ = 0;
  const Collect collect_;
  std::shared_ptr<Watch> watch_;  // set while there are subscribers
};

// /gsv/contacts: contacts that begin in a step.
using ContactTopic = StepEventTopic<messages::gsv_msgs::Contact>;
// /gsv/radio: radio messages and the robots that receive them.
using RadioTopic = StepEventTopic<messages::gsv_msgs::Transmission>;

// The functions `collect` of ContactTopic and RadioTopic.
void CollectContacts(const world::Snapshot& snapshot,
                     std::vector<messages::gsv_msgs::Contact>& found);
void CollectTransmissions(const world::Snapshot& snapshot,
                          std::vector<messages::gsv_msgs::Transmission>& found);

}  // namespace gsv::gateway
