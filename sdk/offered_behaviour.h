// A behaviour that this program offers at a broker during the lifetime of the object.
// ServeBehaviour() (serve.h) is for programs that do nothing else.
//
// Threads  each behaviour's Run() has its own thread. Threads of the ORB call Init(), Paused() and
//          Resumed().
#pragma once

#include <memory>
#include <string>

#include "gsv/base/error.h"
#include "sdk/behaviour/behaviour.h"

namespace gsv {

// The properties that the offer states.
struct BehaviourDescription {
  std::string name;         // the name of the service, such as "wander"
  std::string description;  // one line of text
  // whether it uses only the robot's clock, so that simulations may wait for it
  bool time_managed = true;
};

class OfferedBehaviour {
 public:
  // Offers a behaviour. `broker` is corbaloc::1.2@HOST:PORT/TradingService. `factory` creates one
  // instance per robot.
  static base::Result<std::unique_ptr<OfferedBehaviour>> Offer(
      const std::string& broker, const BehaviourDescription& description, BehaviourFactory factory);
  // Withdraws the offer. Instances that drive robots continue until their simulations end them, or
  // until the last user of the ORB in this process ends.
  virtual ~OfferedBehaviour() = default;

  // The broker's address, to show to users and to pass to other programs.
  virtual const std::string& broker() const = 0;
};

}  // namespace gsv
