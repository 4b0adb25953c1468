// ClientRequests answers the requests of a hub's clients that do not concern channels: parameters,
// service calls and playback control.
//
// Bounded  the pending calls per client.
// Threads  any; no call blocks.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/foxglove/client.h"
#include "gsv/gateway/foxglove/operations.h"

namespace gsv::gateway {

// Answers the clients' requests for parameters, services and playback.
class ClientRequests {
 public:
  // If `operations` is null, every request is refused.
  explicit ClientRequests(std::shared_ptr<Operations> operations);

  // Returns the capabilities for the server info.
  std::vector<std::string> capabilities() const;
  // Sends the list of services to a new client, and the playback state if `knows_playback`.
  void Welcome(const std::shared_ptr<Client>& client, bool knows_playback);
  // Removes a client.
  void Forget(Client* client);

  // Carries out a request and sends the client the answer.
  void Handle(const std::shared_ptr<Client>& client, const foxglove::GetParameters& request) const;
  void Handle(const std::shared_ptr<Client>& client, const foxglove::SetParameters& request) const;
  void Handle(const std::shared_ptr<Client>& client, const foxglove::WatchParameters& request);
  void Handle(const std::shared_ptr<Client>& client, const foxglove::ServiceCall& request);
  void Handle(const std::shared_ptr<Client>& client,
              const foxglove::PlaybackControl& request) const;

  // Sends each client the watched parameters whose values have changed since they were last sent to
  // it, or since it began to watch them. Sends the playback state to the clients for which its
  // status or speed has changed. After a seek (`has_jumped`), sends the state to all clients that
  // know playbacks.
  void PublishChanges(bool has_jumped = false);

  // The names of the services that clients can call.
  std::vector<std::string> service_names() const;

 private:
  struct ClientState {
    std::weak_ptr<Client> client;
    // The playback state that the client has; empty if the client does not get it.
    std::optional<foxglove::PlaybackState> playback = std::nullopt;
    // The watched parameters, with the values that the client has, by name.
    std::map<std::string, foxglove::Parameter> watched = {};
    // The number of pending calls. It is shared with the calls, because a response may arrive after
    // the client or this object was destroyed.
    std::shared_ptr<std::atomic<int>> calls = std::make_shared<std::atomic<int>>(0);
  };

  // Returns null if the client has reached the limit of pending calls.
  std::shared_ptr<std::atomic<int>> BeginCall(Client* client);
  // These functions send changed parameters, and a changed playback state, to the clients.
  void PublishParameters();
  void PublishPlayback(bool has_jumped);

  const std::shared_ptr<Operations> operations_;
  mutable base::Mutex mutex_;
  std::map<Client*, ClientState> clients_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::gateway
