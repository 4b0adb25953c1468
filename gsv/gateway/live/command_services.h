// Commands as services of the Foxglove protocol: /gsv/NAME. A command without parameters has the type
// std_srvs/srv/Trigger, any other gsv_msgs/srv/NAME, with a field for each parameter.
//
// Threads  const members may run concurrently.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/foxglove_requests.h"
#include "gsv/simulation/commands/command.h"

namespace gsv::gateway {

class CommandServices {
 public:
  struct Service {
    simulation::Command command;  // its `apply` is not used
    // Returns the response's message.
    std::function<base::Result<std::string>(const simulation::Arguments& arguments)> run;
  };
  using Response = std::vector<std::byte>;

  explicit CommandServices(std::vector<Service> services) : services_(std::move(services)) {}

  std::vector<foxglove::Service> list() const;

  // What a call asks for, to be run once; it may block. Whether the command was obeyed is in the
  // response. Fails when there is no such service, or the request is not of its type. A field that
  // its parameter's range excludes stands for the default: 0 of a count, NaN, an empty text.
  base::Result<std::function<Response()>> Prepare(const foxglove::ServiceCall& call) const;

 private:
  const std::vector<Service> services_;
};

// The response's message of a command that has nothing to report.
inline base::Result<std::string> NoMessage(const base::Status& done) {
  if (!done) return base::Fail(done.error());
  return std::string();
}

}  // namespace gsv::gateway
