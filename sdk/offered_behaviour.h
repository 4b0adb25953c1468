// A behaviour that this program offers at a broker, for as long as this lives. ServeBehaviour()
// (serve.h) does it for a program that does nothing else.
//
// Threads  behaviours run on threads of their own, their Init(), Paused() and Resumed() on the
// ORB's.
#pragma once

#include <memory>
#include <string>

#include "gsv/base/error.h"
#include "sdk/behaviour/behaviour.h"

namespace gsv {

struct BehaviourDescription {
  std::string name;          // what it is asked for by: "wander"
  std::string description;   // one line
  bool time_managed = true;  // it tells the time by the robot's clock only, so it may be waited for
};

class OfferedBehaviour {
 public:
  // `broker`: corbaloc::1.2@HOST:PORT/TradingService. `factory` makes one instance for each robot.
  static base::Result<std::unique_ptr<OfferedBehaviour>> Offer(
      const std::string& broker, const BehaviourDescription& description, BehaviourFactory factory);
  // Withdraws the offer. Instances that drive robots go on until their simulations end them, or
  // the last use of the ORB in this process is over.
  virtual ~OfferedBehaviour() = default;

  // The broker's address as it should be shown and passed on.
  virtual const std::string& broker() const = 0;
};

}  // namespace gsv
