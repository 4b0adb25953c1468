// Another host, as far as programs can tell: a network of its own behind a slow link, and a name of
// its own, so that nobody there takes this host's sockets for theirs.
#pragma once

#include <string>
#include <vector>

#include "tests/support/programs.h"

namespace gsv::testing {

class OtherHost {
 public:
  // Every round trip to it takes `milliseconds` longer.
  explicit OtherHost(int milliseconds);

  // Why such a thing is not permitted on this machine; empty when it is.
  const std::string& refusal() const { return refusal_; }
  // This host, as seen from there.
  const std::string& address_here() const { return address_here_; }
  // For Running: what runs a program there.
  std::vector<std::string> wrapper() const;

  // Nothing is refused and nothing answers, as when a cable is pulled.
  void Cut();
  void Mend();

 private:
  Running link_;
  std::string refusal_, network_, address_here_;
};

}  // namespace gsv::testing
