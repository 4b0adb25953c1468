// An interface that provides behaviours for robots, so that simulations do not depend on a broker.
#pragma once

#include <memory>
#include <string>

#include "gsv/base/error.h"
#include "gsv/services/stop_timeout.h"
#include "gsv/simulation/behaviour_port.h"

namespace gsv::services {

class BehaviourSource {
 public:
  virtual ~BehaviourSource() = default;

  // Creates a behaviour from an offer that matches `constraint` (in the constraint language of the
  // Trading Service, with the properties in docs/services.md). Makes several remote calls.
  virtual base::Result<std::shared_ptr<simulation::BehaviourPort>> Get(
      const std::string& constraint) = 0;

  // Returns the time limit that all behaviours of this source share; null if there is none.
  virtual std::shared_ptr<StopTimeout> stop_timeout() const { return nullptr; }
};

// Returns the constraint for a behaviour's name, such as: name == 'wander'. Escapes quotes in the
// name.
std::string ConstraintForName(const std::string& name);

}  // namespace gsv::services
