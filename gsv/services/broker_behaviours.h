// Creates behaviours from the broker's offers. Several programs may match; the program that has
// the fewest robots of this object is chosen.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "gsv/base/mutex.h"
#include "gsv/broker/client/broker_client.h"
#include "gsv/services/behaviour_source.h"

namespace gsv::services {

class BrokerBehaviours final : public BehaviourSource {
 public:
  // `broker` must outlive the object. The robots' hardware objects are activated on `poa`.
  BrokerBehaviours(broker::BrokerClient& broker, PortableServer::POA_ptr poa)
      : broker_(broker), poa_(PortableServer::POA::_duplicate(poa)) {}

  base::Result<std::shared_ptr<simulation::BehaviourPort>> Get(
      const std::string& constraint) override;

  std::shared_ptr<StopTimeout> stop_timeout() const override { return stop_timeout_; }

 private:
  // A program that has robots of this object. Each of them owns a reference to it.
  struct Program {};
  struct CountedBehaviour;

  std::shared_ptr<const Program> ProgramAt(const std::string& place);
  // Returns the number of robots that the program at `place` has.
  long RobotsAt(const std::string& place) const GSV_REQUIRES(mutex_);

  broker::BrokerClient& broker_;
  PortableServer::POA_var poa_;
  const std::shared_ptr<StopTimeout> stop_timeout_ = std::make_shared<StopTimeout>();
  base::Mutex mutex_;
  std::map<std::string, std::weak_ptr<const Program>> programs_ GSV_GUARDED_BY(mutex_);  // by place
};

}  // namespace gsv::services
