#include "gsv/gateway/foxglove/client_requests.h"

#include <algorithm>
#include <utility>

namespace gsv::gateway {
namespace {

using foxglove::Parameter;
using foxglove::StatusLevel;

constexpr int kMaxCalls = 8;              // maximum number of calls in progress, per client
constexpr std::size_t kMaxProblems = 10;  // maximum number of problems reported for one request
// The number of updates that were dropped for the client. Each client gets its own value.
constexpr const char* kDroppedUpdates = "/gsv/dropped_updates";

std::vector<Parameter> Named(std::vector<Parameter> all, const std::vector<std::string>& names) {
  if (names.empty()) return all;
  std::erase_if(all, [&](const Parameter& parameter) {
    return std::find(names.begin(), names.end(), parameter.name) == names.end();
  });
  return all;
}

void SendParameters(Client& client, const std::vector<Parameter>& parameters,
                    const std::string& request) {
  client.SendText(SharedBytes(foxglove::ParameterValuesText(parameters, request)));
}

void Answer(Client& client, std::uint32_t service, std::uint32_t call,
            const base::Result<std::vector<std::byte>>& response) {
  if (response) {
    return client.SendBytes(SharedBytes(foxglove::ServiceResponseBytes(service, call, *response)));
  }
  client.SendText(
      SharedBytes(foxglove::ServiceFailureText(service, call, response.error().Sentence())));
}

void RefuseAll(Client& client) {
  client.SendStatus(StatusLevel::kError, "this server offers neither services nor parameters");
}

}  // namespace

ClientRequests::ClientRequests(std::shared_ptr<Operations> operations)
    : operations_(std::move(operations)) {}

std::vector<std::string> ClientRequests::capabilities() const {
  if (!operations_) return {};
  if (operations_->parameters().empty()) return {"services"};
  return {"services", "parameters", "parametersSubscribe"};
}

std::vector<std::string> ClientRequests::service_names() const {
  std::vector<std::string> names;
  if (!operations_) return names;
  for (const foxglove::Service& service : operations_->services()) names.push_back(service.name);
  return names;
}

void ClientRequests::Welcome(const std::shared_ptr<Client>& client, bool knows_playback) {
  if (!operations_) return;
  client->SendText(SharedBytes(foxglove::AdvertiseServicesText(operations_->services())));
  const auto playback = operations_->playback();
  if (knows_playback && playback) {
    client->SendBytes(SharedBytes(foxglove::PlaybackStateBytes(*playback)));
  }
  const base::MutexLock lock(mutex_);
  ClientState& state = clients_[client.get()];
  state = ClientState{client};
  if (knows_playback) state.playback = playback;
}

void ClientRequests::Forget(Client* client) {
  const base::MutexLock lock(mutex_);
  clients_.erase(client);
}

void ClientRequests::Handle(const std::shared_ptr<Client>& client,
                            const foxglove::GetParameters& request) const {
  if (!operations_) return RefuseAll(*client);
  std::vector<Parameter> parameters = Named(operations_->parameters(), request.names);
  const auto& names = request.names;
  if (std::find(names.begin(), names.end(), kDroppedUpdates) != names.end()) {
    parameters.push_back({kDroppedUpdates, static_cast<double>(client->dropped_updates())});
  }
  SendParameters(*client, parameters, request.request);
}

void ClientRequests::Handle(const std::shared_ptr<Client>& client,
                            const foxglove::SetParameters& request) const {
  if (!operations_) return RefuseAll(*client);
  std::vector<std::string> names;
  std::size_t complaints = 0;
  for (const Parameter& parameter : request.parameters) {
    names.push_back(parameter.name);
    const base::Status may = client->CheckControl();
    const base::Status set = may ? operations_->Set(parameter) : may;
    if (set || ++complaints > kMaxProblems) continue;
    client->SendStatus(StatusLevel::kError, set.error().Sentence());
  }
  // Sends the current values, whether they were set or not.
  if (request.request.empty() || names.empty()) return;
  SendParameters(*client, Named(operations_->parameters(), names), request.request);
}

void ClientRequests::Handle(const std::shared_ptr<Client>& client,
                            const foxglove::WatchParameters& request) {
  if (!operations_) return RefuseAll(*client);
  const std::vector<Parameter> parameters = Named(operations_->parameters(), request.names);
  const base::MutexLock lock(mutex_);
  const auto guest = clients_.find(client.get());
  if (guest == clients_.end()) return;
  for (const Parameter& parameter : parameters) {
    if (request.is_end) {
      guest->second.watched.erase(parameter.name);
    } else {
      guest->second.watched.emplace(parameter.name, parameter);
    }
  }
}

std::shared_ptr<std::atomic<int>> ClientRequests::BeginCall(Client* client) {
  const base::MutexLock lock(mutex_);
  const auto guest = clients_.find(client);
  if (guest == clients_.end() || *guest->second.calls >= kMaxCalls) return nullptr;
  ++*guest->second.calls;
  return guest->second.calls;
}

void ClientRequests::Handle(const std::shared_ptr<Client>& client,
                            const foxglove::ServiceCall& request) {
  const auto fail = [&](const std::string& why) {
    client->SendText(SharedBytes(foxglove::ServiceFailureText(request.service, request.call, why)));
  };
  if (!operations_) return fail("this server offers no services");
  if (request.encoding != "cdr") return fail("service requests must use the encoding 'cdr'");
  if (const base::Status may = client->CheckControl(); !may) return fail(may.error().Sentence());
  const std::shared_ptr<std::atomic<int>> calls = BeginCall(client.get());
  if (!calls)
    return fail("too many calls of this client are in progress; wait for their responses");
  operations_->Call(request,
                    [caller = std::weak_ptr<Client>(client), calls, service = request.service,
                     call = request.call](const base::Result<std::vector<std::byte>>& response) {
                      --*calls;
                      if (const std::shared_ptr<Client> waiting = caller.lock()) {
                        Answer(*waiting, service, call, response);
                      }
                    });
}

void ClientRequests::Handle(const std::shared_ptr<Client>& client,
                            const foxglove::PlaybackControl& request) const {
  const auto before = operations_ ? operations_->playback() : std::nullopt;
  if (!before)
    return client->SendStatus(StatusLevel::kError,
                              "this server has no playback; only replays have one");
  const base::Status may = client->CheckControl();
  if (const base::Status done = may ? operations_->Control(request) : may; !done) {
    client->SendStatus(StatusLevel::kError, done.error().Sentence());
  }
  foxglove::PlaybackState state = operations_->playback().value_or(*before);
  state.did_seek = request.seek_ns.has_value();
  state.request = request.request;
  client->SendBytes(SharedBytes(foxglove::PlaybackStateBytes(state)));
}

void ClientRequests::PublishChanges(bool has_jumped) {
  if (!operations_) return;
  PublishParameters();
  PublishPlayback(has_jumped);
}

void ClientRequests::PublishParameters() {
  const std::vector<Parameter> now = operations_->parameters();
  const base::MutexLock lock(mutex_);
  for (auto& [key, guest] : clients_) {
    std::vector<Parameter> changed;
    for (const Parameter& parameter : now) {
      const auto watched = guest.watched.find(parameter.name);
      if (watched == guest.watched.end() || watched->second == parameter) continue;
      watched->second = parameter;
      changed.push_back(parameter);
    }
    const std::shared_ptr<Client> client = guest.client.lock();
    if (client && !changed.empty()) SendParameters(*client, changed, {});
  }
}

void ClientRequests::PublishPlayback(bool has_jumped) {
  auto state = operations_->playback();
  if (!state) return;
  state->did_seek = has_jumped;
  const SharedBytes bytes(foxglove::PlaybackStateBytes(*state));
  const base::MutexLock lock(mutex_);
  for (auto& [key, guest] : clients_) {
    if (!guest.playback) continue;
    const bool is_news = has_jumped || state->status != guest.playback->status ||
                         state->speed != guest.playback->speed;
    guest.playback = state;
    const std::shared_ptr<Client> client = guest.client.lock();
    if (client && is_news) client->SendBytes(bytes);
  }
}

}  // namespace gsv::gateway
