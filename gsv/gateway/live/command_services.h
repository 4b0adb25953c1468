// Commands as services of the Foxglove protocol: /gsv/NAME, of the type std_srvs/srv/Trigger, or
// gsv_msgs/srv/Step where a number of steps goes with it.
//
// Threads  const members may run concurrently.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/foxglove_requests.h"

namespace gsv::gateway {

class CommandServices {
 public:
  struct Command {
    std::string name;
    bool takes_count = false;
    // Gives the response's message.
    std::function<base::Result<std::string>(std::int64_t count)> run;
  };
  using Response = std::vector<std::byte>;

  explicit CommandServices(std::vector<Command> commands) : commands_(std::move(commands)) {}

  std::vector<foxglove::Service> list() const;

  // What a call asks for, to be run once; it may block. Whether the command was obeyed is in the
  // response. Fails when there is no such service, or the request is not of its type.
  base::Result<std::function<Response()>> Prepare(const foxglove::ServiceCall& call) const;

 private:
  const std::vector<Command> commands_;
};

}  // namespace gsv::gateway
