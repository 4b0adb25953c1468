// Starts the behaviour programs that ship with gsv, for behaviours that nobody offers yet.
//
// Threads  the thread that made it.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "apps/gsv/machine/child_process.h"
#include "gsv/broker/client/broker_client.h"

namespace gsv::app {

class BehaviourLauncher {
 public:
  // `broker` outlives it.
  explicit BehaviourLauncher(broker::BrokerClient& broker) : broker_(broker) {}
  // Ends the programs: SIGTERM to all at once, and SIGKILL to those that are still there when the
  // patience is over.
  ~BehaviourLauncher();
  BehaviourLauncher(const BehaviourLauncher&) = delete;
  BehaviourLauncher& operator=(const BehaviourLauncher&) = delete;

  // Wall time that all programs together have to end (default: 2 s).
  void SetPatience(std::chrono::milliseconds patience) { patience_ = patience; }

  // Sees to it that the behaviour is offered. If it is not, starts `programs` of the program
  // gsv-NAME, which lies beside this one or on PATH, and waits until they offer it. `behaviour` is
  // a name and, after blanks, options for the program: it is offered under the whole of that.
  base::Status Ensure(const std::string& behaviour, int programs);

 private:
  broker::BrokerClient& broker_;
  std::vector<std::unique_ptr<ChildProcess>> children_;
  std::chrono::milliseconds patience_{2000};
};

}  // namespace gsv::app
