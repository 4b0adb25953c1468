// Tests which of several behaviour programs gets a robot. The programs are factories in this
// process, which are offered at a real broker.
#include <gtest/gtest.h>

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/orb.h"
#include "gsv/services/broker_behaviours.h"
#include "sdk/behaviour_servant.h"
#include "tests/end_to_end/served.h"
#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

class Idle final : public Behaviour {
 public:
  base::Status Init(Robot&) override { return {}; }
  void Run(Robot&) override {}
};

TEST(BehaviourChoice, ProgramWithTheFewestRobotsGetsTheNext) {
  const BrokerProcess broker;
  const auto orb = StartOrbWithLongTimeout();
  ASSERT_TRUE(orb) << orb.error().Sentence();
  {
    auto client = broker::BrokerClient::Connect(*orb, broker.reference());
    ASSERT_TRUE(client) << client.error().Sentence();
    ASSERT_TRUE(client->EnsureServiceType(broker::AgentBehaviourFactoryType()));
    const PortableServer::POA_var poa = orb::RootPoa(*orb);
    const PortableServer::Servant_var<sdk::BehaviourFactoryServant> factory(
        new sdk::BehaviourFactoryServant(poa, [] { return std::make_unique<Idle>(); }));
    const PortableServer::ObjectId_var id = poa->activate_object(factory);
    const CORBA::Object_var reference = poa->id_to_reference(id);
    for (const int pid : {1, 2}) {
      const broker::BehaviourOffer offer{"idle", "", "host", pid, true};
      ASSERT_TRUE(client->Export(broker::AgentBehaviourFactoryType().name, reference,
                                 broker::PropertiesOf(offer)));
    }
    services::BrokerBehaviours behaviours(*client, poa);
    const auto next = [&] {
      auto behaviour = behaviours.Get("name == 'idle'");
      EXPECT_TRUE(behaviour) << behaviour.error().Sentence();
      return *behaviour;
    };
    auto first = next(), second = next();
    EXPECT_NE(first->place(), second->place());
    const auto third = next();
    const auto fourth = next();
    EXPECT_NE(third->place(), fourth->place());
    // Both have two robots. When one of them has one robot less, it gets the next one.
    const std::string freed = first->place();
    first->Destroy();
    first.reset();
    EXPECT_EQ(next()->place(), freed);
    EXPECT_EQ(next()->place(), freed);  // the robot of the previous line does not exist any more
    second->Destroy();
    third->Destroy();
    fourth->Destroy();
  }
  (*orb)->destroy();
}

}  // namespace
}  // namespace gsv::testing
