// Starts the program gsv-NAME for a behaviour NAME that the broker does not offer yet.
//
// Threads  the thread that created it.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "apps/gsv/machine/child_process.h"
#include "apps/gsv/serving/behaviour_output.h"
#include "gsv/broker/client/broker_client.h"

namespace gsv::app {

// Returns the behaviours whose programs gsv-NAME are beside this program, in alphabetical order.
std::vector<std::string> BehaviourPrograms();

class BehaviourLauncher {
 public:
  // `broker` must outlive this object. `list`: see BehaviourOutput.
  BehaviourLauncher(broker::BrokerClient& broker, BehaviourOutput::ListSimulations list)
      : broker_(broker), output_(std::move(list)) {}
  // Ends the programs. Sends SIGTERM to all programs at once, and SIGKILL to each program that
  // still runs after the time limit.
  ~BehaviourLauncher();
  BehaviourLauncher(const BehaviourLauncher&) = delete;
  BehaviourLauncher& operator=(const BehaviourLauncher&) = delete;

  // Sets the wall-clock time limit for all programs together to end (default: 2 s).
  void SetEndTimeout(std::chrono::milliseconds timeout) { end_timeout_ = timeout; }

  // See BehaviourOutput::WaitForOutput().
  void WaitForOutput() { output_.WaitForOutput(); }

  // Makes sure that the behaviour is offered. If it is not, starts `programs` processes (at most
  // 64) of gsv-NAME, which is beside this program or on PATH, and waits until they offer it.
  // `behaviour` is a name and, after spaces, options for the program. The whole text is the name of
  // the offer.
  base::Status Ensure(const std::string& behaviour, int programs);

 private:
  broker::BrokerClient& broker_;
  std::vector<std::unique_ptr<ChildProcess>> children_;  // the started programs
  BehaviourOutput output_;                               // output of children_
  std::chrono::milliseconds end_timeout_{2000};
};

}  // namespace gsv::app
