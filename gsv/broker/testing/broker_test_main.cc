// For tests: a broker in its own process. It prints its reference and serves until its parent ends.
#include <cstdlib>
#include <cstring>
#include <string>

#include <unistd.h>

#include "gsv/broker/broker_command.h"

// The arguments are the port, then limits as NAME=VALUE, and data=FILE for the data file.
int main(int argc, char** argv) {
  gsv::broker::BrokerCommand command;
  command.parent = getppid();
  command.broker.port = argc > 1 ? static_cast<std::uint16_t>(std::atoi(argv[1])) : 0;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t equals = argument.find('=');
    const std::string name = argument.substr(0, equals);
    if (name == "data") command.broker.data_file = argument.substr(equals + 1);
    const auto value = static_cast<std::size_t>(std::atoll(argument.c_str() + equals + 1));
    if (name == "liveness_ms") command.broker.liveness.period = std::chrono::milliseconds(value);
    if (name == "max_silence_ms")
      command.broker.liveness.max_silence = std::chrono::milliseconds(value);
    if (name == "per_hop_ms") {
      command.broker.limits.federation.per_hop = std::chrono::milliseconds(value);
    }
    if (name == "iterators") command.broker.limits.iterators = value;
    if (name == "address_space_mib") command.process.address_space_bytes = value << 20;
  }
  return gsv::broker::BrokerMain(command);
}
