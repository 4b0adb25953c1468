// For tests: a network namespace that acts as another host. It has its own network behind a slow
// link, and its own host name. So programs in it cannot use this host's sockets.
#pragma once

#include <string>
#include <vector>

#include "tests/support/programs.h"

namespace gsv::testing {

// A host in a network namespace, which exists as long as this object.
class OtherHost {
 public:
  // Every round trip to the host takes `milliseconds` longer.
  explicit OtherHost(int milliseconds);

  // The reason why this machine does not permit such a namespace; empty if it does.
  const std::string& refusal() const { return refusal_; }
  // The address of this host, as seen from the other host.
  const std::string& address_here() const { return address_here_; }
  // The wrapper for Running that starts a program on the other host.
  std::vector<std::string> wrapper() const;

  // Cuts the link. Connections then get neither an answer nor an error, as if a cable were
  // unplugged.
  void Cut();
  void Mend();

 private:
  Running link_;
  std::string refusal_, network_, address_here_;
};

}  // namespace gsv::testing
