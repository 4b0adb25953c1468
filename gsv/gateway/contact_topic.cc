#include "gsv/gateway/contact_topic.h"

#include <deque>
#include <mutex>
#include <utility>

#include "gsv/gateway/channels.h"
#include "gsv/presentation/state_messages.h"

namespace gsv::gateway {
namespace {

// In a round; so that room for other data is left in a viewer's queue.
constexpr std::size_t kMostContacts = 64;

}  // namespace

// Keeps what met. On the stepping thread that is a look at the list of what touches.
class ContactTopic::Watch final : public simulation::Observer {
 public:
  using Meeting = std::pair<base::SimTime, messages::gsv_msgs::Contact>;

  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override {
    for (const world::Contact& contact : snapshot->contacts) {
      if (!contact.began) continue;
      Meeting meeting(snapshot->state.time, presentation::ContactMessage(*snapshot, contact));
      const std::lock_guard lock(mutex_);
      if (meetings_.size() == kMostContacts) meetings_.pop_front();
      meetings_.push_back(std::move(meeting));
    }
  }
  void OnEvent(const simulation::Event&) override {}

  std::deque<Meeting> Take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(meetings_, {});
  }

 private:
  std::mutex mutex_;
  std::deque<Meeting> meetings_;
};

ContactTopic::ContactTopic(std::shared_ptr<Hub> hub)
    : hub_(std::move(hub)),
      channel_(
          hub_->Advertise({ChannelFor<messages::gsv_msgs::Contact>("/gsv/contacts")}).front()) {}

ContactTopic::~ContactTopic() = default;

void ContactTopic::Publish(simulation::Simulation& simulation) {
  if (!hub_->IsSubscribed(channel_)) {
    if (watch_) simulation.RemoveObserver(std::exchange(watch_, nullptr));
    return;
  }
  if (!watch_) {
    watch_ = std::make_shared<Watch>();
    simulation.AddObserver(watch_);
  }
  if (hub_->HasNewcomers(channel_)) hub_->Welcome(channel_, {});
  for (const auto& [time, contact] : watch_->Take()) {
    hub_->Publish(channel_, {static_cast<std::uint64_t>(time.count()), Encoded(contact)});
  }
}

}  // namespace gsv::gateway
