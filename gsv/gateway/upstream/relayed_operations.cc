#include "gsv/gateway/upstream/relayed_operations.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/gateway/http/target.h"
#include "gsv/gateway/upstream/fetch.h"
#include "gsv/simulation/commands/command_table.h"

namespace gsv::gateway::upstream {
namespace {

// Time limit for a request. It is long, because a reset waits for behaviours.
constexpr std::chrono::seconds kRelayedRequestTime{60};

base::Result<Response> Ask(const Address& address, const char* method, std::string target,
                           std::string body) {
  Request request;
  request.method = method;
  request.raw_target = std::move(target);
  request.content_type = "application/json";
  request.body = std::move(body);
  return Fetch(address, request, kRelayedRequestTime);
}

base::Result<std::string> FirstSimulation(const Address& address) {
  const auto answer = Ask(address, "GET", "/api/simulations", "");
  if (!answer) return base::Fail(answer.error());
  const auto list = nlohmann::json::parse(answer->body.view(), nullptr, false);
  const bool has_any = list.is_array() && !list.empty() && list[0].is_object();
  const auto name = has_any ? list[0].value("name", nlohmann::json()) : nlohmann::json();
  if (name.is_string()) return name.get<std::string>();
  return base::Fail(base::ErrorCode::kNotFound, "there is no simulation", address.Url());
}

base::Result<std::string> Command(const Address& address, std::string simulation,
                                  const std::string& command,
                                  const simulation::Arguments& arguments) {
  if (simulation.empty()) {
    auto first = FirstSimulation(address);
    if (!first) return base::Fail(first.error());
    simulation = *std::move(first);
  }
  nlohmann::json body = nlohmann::json::object();
  for (const auto& [name, value] : arguments.values()) {
    std::visit([&body, &name = name](const auto& each) { body[name] = each; }, value);
  }
  const auto answer = Ask(address, "POST", "/api/simulations/" + Escape(simulation) + "/" + command,
                          body.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  if (!answer) return base::Fail(answer.error());
  if (answer->status == 200) return std::string();
  const auto json = nlohmann::json::parse(answer->body.view(), nullptr, false);
  const auto sentence = json.is_object() ? json.find("error") : json.end();
  const bool has_sentence = json.is_object() && sentence != json.end() && sentence->is_string();
  return base::Fail(
      base::ErrorCode::kNotRunning,
      has_sentence ? sentence->get<std::string>()
                   : "the other instance answers with status " + std::to_string(answer->status),
      address.Url());
}

std::vector<CommandServices::Service> ServicesOf(const Address& address,
                                                 const std::string& simulation) {
  std::vector<CommandServices::Service> services;
  for (const simulation::Command& command : simulation::CommandsWithFormerNames()) {
    services.push_back({command, [address, simulation, name = std::string(command.name)](
                                     const simulation::Arguments& arguments) {
                          return Command(address, simulation, name, arguments);
                        }});
  }
  return services;
}

}  // namespace

RelayedOperations::RelayedOperations(const Address& address, const std::string& simulation,
                                     WorkerPool& workers)
    : workers_(workers), services_(ServicesOf(address, simulation)) {}

void RelayedOperations::Call(const foxglove::ServiceCall& call, Answer answer) {
  auto command = services_.Prepare(call);
  if (!command) return answer(base::Fail(command.error()));
  const bool is_accepted = workers_.Submit([run = *std::move(command), answer] { answer(run()); });
  if (!is_accepted) {
    answer(base::Fail(base::ErrorCode::kUnavailable, "the relay is busy; try again in a moment"));
  }
}

base::Status RelayedOperations::Set(const foxglove::Parameter&) {
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "a relay cannot set parameters; set them at the other instance");
}

}  // namespace gsv::gateway::upstream
