// Creates behaviours from the broker's offers. Several programs may match; the program that has
// got the fewest robots from this object so far is chosen.
#pragma once

#include <map>
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
  // Adds `change` to the number of robots that the program at `place` has got.
  void CountRobot(const std::string& place, int change);

  broker::BrokerClient& broker_;
  PortableServer::POA_var poa_;
  const std::shared_ptr<StopTimeout> stop_timeout_ = std::make_shared<StopTimeout>();
  base::Mutex mutex_;
  // number of robots that a program has got so far, by "host:pid"
  std::map<std::string, int> robots_of_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::services
