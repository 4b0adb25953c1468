#include "gsv/gateway/live/command_services.h"

#include "gsv/gateway/live/simulation_commands.h"
#include "gsv/messages/cdr.h"

namespace gsv::gateway {
namespace {

using foxglove::Service;

// The encapsulation header, and the octet that ROS 2 puts into an empty message.
constexpr std::size_t kLongestEmpty = 8;

constexpr const char* kResponse = "bool success\nstring message\n";

Service Trigger(std::uint32_t id, const std::string& name) {
  return {id,
          "/gsv/" + name,
          "std_srvs/srv/Trigger",
          {"std_srvs/srv/Trigger_Request", ""},
          {"std_srvs/srv/Trigger_Response", kResponse}};
}

Service Step(std::uint32_t id, const std::string& name) {
  return {id,
          "/gsv/" + name,
          "gsv_msgs/srv/Step",
          {"gsv_msgs/srv/Step_Request", "# how many steps; 0: one\nuint64 count\n"},
          {"gsv_msgs/srv/Step_Response", kResponse}};
}

base::Result<std::int64_t> CountOf(const foxglove::ServiceCall& call) {
  messages::CdrReader reader(std::as_bytes(std::span(call.request)));
  std::uint64_t count = 0;
  reader.Read(count);
  if (const base::Status whole = reader.Finish(); !whole) return base::Fail(whole.error());
  if (count > kMostSteps) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "'count' must be a number of steps from 1 to 1000000000");
  }
  return count == 0 ? 1 : static_cast<std::int64_t>(count);
}

base::Result<std::int64_t> NothingIn(const foxglove::ServiceCall& call) {
  if (call.request.size() <= kLongestEmpty) return 0;
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "this service's request is empty; what came is longer");
}

CommandServices::Response ResponseTo(const base::Result<std::string>& done) {
  CommandServices::Response bytes;
  messages::CdrWriter writer(bytes);
  writer.Write(done.has_value());
  writer.Write(done ? *done : done.error().Sentence());
  return bytes;
}

}  // namespace

std::vector<Service> CommandServices::list() const {
  std::vector<Service> services;
  for (const Command& command : commands_) {
    const auto id = static_cast<std::uint32_t>(services.size() + 1);
    services.push_back(command.takes_count ? Step(id, command.name) : Trigger(id, command.name));
  }
  return services;
}

base::Result<std::function<CommandServices::Response()>> CommandServices::Prepare(
    const foxglove::ServiceCall& call) const {
  if (call.service == 0 || call.service > commands_.size()) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no service " + std::to_string(call.service));
  }
  const Command& command = commands_[call.service - 1];
  const base::Result<std::int64_t> count = command.takes_count ? CountOf(call) : NothingIn(call);
  if (!count) return base::Fail(count.error());
  return [run = command.run, count = *count] { return ResponseTo(run(count)); };
}

}  // namespace gsv::gateway
