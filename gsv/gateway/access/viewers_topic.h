// Who is there and who holds control, live: /gsv/viewers, as soon as it is otherwise. Its text is
// the JSON of GET /api/viewers, without `you`.
//
// Threads  Publish() from one.
#pragma once

#include <memory>

#include "gsv/gateway/access/viewer_registry.h"
#include "gsv/gateway/foxglove/hub.h"

namespace gsv::gateway::access {

class ViewersTopic {
 public:
  // Advertises the topic. `registry` outlives this; null: nobody is known here, and nothing advertised.
  ViewersTopic(std::shared_ptr<Hub> hub, ViewerRegistry* registry);

  // Publishes what is news, if somebody listens.
  void Publish(ViewerRegistry::Time now);

 private:
  const std::shared_ptr<Hub> hub_;
  ViewerRegistry* const registry_;
  foxglove::ChannelId channel_ = 0;
  std::uint64_t version_ = 0;  // that was published
};

}  // namespace gsv::gateway::access
