#include "gsv/services/broker_behaviours.h"

#include <chrono>

#include "gsv/base/sorting.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/errors.h"
#include "gsv/orb/orb.h"
#include "gsv/services/remote_behaviour.h"

namespace gsv::services {
namespace {

constexpr std::chrono::milliseconds kCreateTimeout{5000};
// The maximum number of matching offers that are tried. Several offers are tried, because some of
// their programs may have died.
constexpr std::size_t kOffersConsidered = 256;

std::string PlaceOf(const broker::BehaviourOffer& offer) {
  return offer.host + ":" + std::to_string(offer.pid);
}

}  // namespace

// A behaviour, and the program that has it.
struct BrokerBehaviours::CountedBehaviour {
  CountedBehaviour(sba::AgentBehaviour_ptr of, BehaviourIdentity identity,
                   PortableServer::POA_ptr poa, std::shared_ptr<const StopTimeout> stop_timeout,
                   std::shared_ptr<const Program> its_program)
      : program(std::move(its_program)),
        behaviour(of, std::move(identity), poa, std::move(stop_timeout)) {}

  const std::shared_ptr<const Program> program;
  RemoteBehaviour behaviour;
};

base::Result<std::shared_ptr<simulation::BehaviourPort>> BrokerBehaviours::Get(
    const std::string& constraint) {
  const broker::ServiceType& type = broker::AgentBehaviourFactoryType();
  auto offers = broker_.Query(type.name, constraint, "first", kOffersConsidered);
  // A broker does not know the service type until the first behaviour is offered. Therefore,
  // kNotFound means that there is no offer.
  if (!offers && offers.error().code == base::ErrorCode::kNotFound)
    offers = std::vector<broker::FoundOffer>();
  if (!offers) return base::Fail(offers.error());
  base::Error error{base::ErrorCode::kBehaviour,
                    "no offered behaviour matches the constraint: " + constraint +
                        " (see `gsv offers`; start the behaviour program with --broker " +
                        broker_.reference() + ")",
                    broker_.reference()};
  // Counted before the sort, because other threads may end robots during it.
  std::map<std::string, long> robots_at;
  {
    const base::MutexLock lock(mutex_);
    for (const broker::FoundOffer& offer : *offers) {
      const std::string place = PlaceOf(broker::BehaviourOfferFrom(offer.properties));
      robots_at.try_emplace(place, RobotsAt(place));
    }
  }
  base::Sort(*offers, [&](const auto& a, const auto& b) {
    return robots_at[PlaceOf(broker::BehaviourOfferFrom(a.properties))] <
           robots_at[PlaceOf(broker::BehaviourOfferFrom(b.properties))];
  });
  for (const broker::FoundOffer& offer : *offers) {
    const broker::BehaviourOffer described = broker::BehaviourOfferFrom(offer.properties);
    const BehaviourIdentity identity{described.name, PlaceOf(described), described.time_managed};
    orb::LimitCalls(offer.object, kCreateTimeout);
    // the robot is counted before the call, so that concurrent calls choose other programs
    auto program = ProgramAt(identity.place);
    auto behaviour = orb::Call(identity.name + " on " + identity.place, [&] {
      const sba::AgentBehaviourFactory_var factory =
          sba::AgentBehaviourFactory::_narrow(offer.object);
      if (CORBA::is_nil(factory)) throw sba::Failed("the offer is not an AgentBehaviourFactory");
      return sba::AgentBehaviour_var(factory->create());
    });
    if (behaviour) {
      const auto counted = std::make_shared<CountedBehaviour>(*behaviour, identity, poa_,
                                                              stop_timeout_, std::move(program));
      return std::shared_ptr<simulation::BehaviourPort>(counted, &counted->behaviour);
    }
    error = behaviour.error();
    error.code = base::ErrorCode::kBehaviour;
  }
  return base::Fail(std::move(error));
}

std::shared_ptr<const BrokerBehaviours::Program> BrokerBehaviours::ProgramAt(
    const std::string& place) {
  const base::MutexLock lock(mutex_);
  std::erase_if(programs_, [](const auto& program) { return program.second.expired(); });
  std::weak_ptr<const Program>& known = programs_[place];
  std::shared_ptr<const Program> program = known.lock();
  if (program == nullptr) known = program = std::make_shared<const Program>();
  return program;
}

long BrokerBehaviours::RobotsAt(const std::string& place) const {
  const auto program = programs_.find(place);
  return program == programs_.end() ? 0 : program->second.use_count();
}

}  // namespace gsv::services
