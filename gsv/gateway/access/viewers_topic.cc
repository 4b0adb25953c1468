#include "gsv/gateway/access/viewers_topic.h"

#include <utility>

#include "gsv/gateway/access/viewers_api.h"
#include "gsv/gateway/foxglove/channels.h"
#include "gsv/messages/std_msgs.h"

namespace gsv::gateway::access {

ViewersTopic::ViewersTopic(std::shared_ptr<Hub> hub, ViewerRegistry* registry)
    : hub_(std::move(hub)), registry_(registry) {
  if (registry_ == nullptr) return;
  channel_ = hub_->Advertise({ChannelFor(presentation::topics::kViewers)}).front();
}

void ViewersTopic::Publish(ViewerRegistry::Time now) {
  if (registry_ == nullptr || !hub_->IsSubscribed(channel_)) return;
  const std::uint64_t version = registry_->Version(now);
  const bool is_news = version != version_;
  if (!is_news && !hub_->HasNewSubscribers(channel_)) return;
  version_ = version;
  const std::string text = ViewerListJson(registry_->List("", now));
  const Hub::Message message{0, Encoded(messages::std_msgs::String{text})};
  if (is_news) return hub_->Publish(channel_, message);
  hub_->Welcome(channel_, {&message, 1});
}

}  // namespace gsv::gateway::access
