// CommandServices offers commands as services of the Foxglove protocol: /gsv/NAME. A command
// without parameters has the type std_srvs/srv/Trigger. Others have the type gsv_msgs/srv/NAME,
// with a field per parameter.
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

// Offers commands as services of the Foxglove protocol.
class CommandServices {
 public:
  struct Service {
    simulation::Command command;  // the command of a service; its function `apply` is not used
    // Returns the response's message.
    std::function<base::Result<std::string>(const simulation::Arguments& arguments)> run;
  };
  using Response = std::vector<std::byte>;

  explicit CommandServices(std::vector<Service> services) : services_(std::move(services)) {}

  // The services that clients can call.
  std::vector<foxglove::Service> list() const;

  // Returns a function that carries out the call. Run it once; it may block. Fails for an unknown
  // service or an invalid request. A request has all fields, so some values mean "use the default"
  // if the parameter is optional: NaN for a number, an empty text, and 0 for an integer whose
  // minimum is greater.
  base::Result<std::function<Response()>> Prepare(const foxglove::ServiceCall& call) const;

 private:
  const std::vector<Service> services_;
};

// Returns an empty message for a response, or the error.
inline base::Result<std::string> NoMessage(const base::Status& done) {
  if (!done) return base::Fail(done.error());
  return std::string();
}

}  // namespace gsv::gateway
