// Takes the requests of a hub's clients that are not about channels, and answers them.
//
// Bounded  the calls of one client that are under way; what clients watch is part of what there is.
// Threads  any; no call blocks.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/foxglove/client.h"
#include "gsv/gateway/foxglove/operations.h"

namespace gsv::gateway {

class ClientRequests {
 public:
  // `operations` may be null: then every request is refused.
  explicit ClientRequests(std::shared_ptr<Operations> operations);

  // What a server declares for this.
  std::vector<std::string> capabilities() const;
  // Tells a new client which services there are, and one that knows playbacks how this one stands.
  void Welcome(const std::shared_ptr<Client>& client, bool knows_playback);
  void Forget(Client* client);

  void Take(const std::shared_ptr<Client>& client, const foxglove::GetParameters& request) const;
  void Take(const std::shared_ptr<Client>& client, const foxglove::SetParameters& request) const;
  void Take(const std::shared_ptr<Client>& client, const foxglove::WatchParameters& request);
  void Take(const std::shared_ptr<Client>& client, const foxglove::ServiceCall& request);
  void Take(const std::shared_ptr<Client>& client, const foxglove::PlaybackControl& request) const;

  // Tells those who watch which parameters have changed since the last call, and those who know
  // playbacks if this one has jumped, or goes otherwise than then.
  void PublishChanges(bool has_jumped = false);

  std::vector<std::string> service_names() const;

 private:
  struct ClientState {
    std::weak_ptr<Client> client;
    bool knows_playback = false;
    std::set<std::string> watched;  // parameters
    // How many are under way. Whoever answers may do so after the client, or this, has gone.
    std::shared_ptr<std::atomic<int>> calls = std::make_shared<std::atomic<int>>(0);
  };

  // Null if the client has as many calls under way as it may.
  std::shared_ptr<std::atomic<int>> BeginCall(Client* client);
  void PublishParameters();
  void PublishPlayback(bool has_jumped);

  const std::shared_ptr<Operations> operations_;
  mutable base::Mutex mutex_;
  std::map<Client*, ClientState> clients_ GSV_GUARDED_BY(mutex_);
  std::vector<foxglove::Parameter> told_
      GSV_GUARDED_BY(mutex_);  // of the parameters, when last published
  foxglove::PlaybackState playback_ GSV_GUARDED_BY(mutex_);  // when last published
};

}  // namespace gsv::gateway
