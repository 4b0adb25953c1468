// ViewersTopic publishes the live topic /gsv/viewers: the viewers, and which of them hold control,
// at each change. A message has the JSON text of GET /api/viewers, without `you`.
//
// Threads  Publish() from one thread.
#pragma once

#include <memory>

#include "gsv/gateway/access/viewer_registry.h"
#include "gsv/gateway/foxglove/hub.h"

namespace gsv::gateway::access {

// Publishes the live topic /gsv/viewers.
class ViewersTopic {
 public:
  // Advertises the topic. `registry` must outlive this; null: nothing is advertised.
  ViewersTopic(std::shared_ptr<Hub> hub, ViewerRegistry* registry);

  // Publishes changes, if there are subscribers.
  void Publish(ViewerRegistry::Time now);

 private:
  const std::shared_ptr<Hub> hub_;
  ViewerRegistry* const registry_;
  foxglove::ChannelId channel_ = 0;
  std::uint64_t version_ = 0;  // the version of the last message
};

}  // namespace gsv::gateway::access
