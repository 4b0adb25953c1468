// Views is the interface for images that the server draws for the clients of a hub.
//
// Threads  any; no call blocks. Images are sent later, from another thread.
#pragma once

#include <memory>

#include "gsv/gateway/foxglove/client.h"
#include "gsv/gateway/foxglove/foxglove_requests.h"

namespace gsv::gateway {

// If the server info lists this capability, the server draws views.
inline constexpr const char* kViewsCapability = "gsvViews";

// The interface for images that the server draws for clients.
class Views {
 public:
  virtual ~Views() = default;
  // Starts to send the images of a view. If the client has a view with this id, its camera changes.
  virtual void Handle(const std::shared_ptr<Client>& client,
                      const foxglove::WatchView& request) = 0;
  virtual void Handle(const std::shared_ptr<Client>& client,
                      const foxglove::UnwatchView& request) = 0;
  virtual void Handle(const std::shared_ptr<Client>& client,
                      const foxglove::ViewShown& request) = 0;
  // Ends all views of a client.
  virtual void Forget(Client* client) = 0;
};

}  // namespace gsv::gateway
