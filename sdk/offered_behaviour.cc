#include "sdk/offered_behaviour.h"

#include <unistd.h>

#include "gsv/base/host_name.h"
#include "gsv/base/log.h"
#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/orb.h"
#include "sdk/behaviour_servant.h"
#include "sdk/shared_orb.h"

namespace gsv {
namespace {

class ExportedBehaviour final : public OfferedBehaviour {
 public:
  ExportedBehaviour(std::shared_ptr<sdk::SharedOrb> orb, broker::BrokerClient client,
                    BehaviourFactory factory)
      : orb_(std::move(orb)),
        client_(std::move(client)),
        poa_(orb::RootPoa(orb_->orb())),
        servant_(new sdk::BehaviourFactoryServant(poa_, std::move(factory))),
        id_(poa_->activate_object(servant_)) {}
  ~ExportedBehaviour() override {
    if (!offer_.empty()) {
      if (auto ok = client_.Withdraw(offer_); !ok) {
        // If the broker has ended, the offer no longer exists. So a failed withdrawal is no error.
        spdlog::debug("{}", ok.error().Sentence());
      }
    }
    poa_->deactivate_object(id_);
  }

  base::Status Export(const BehaviourDescription& description) {
    const CORBA::Object_var reference = poa_->id_to_reference(id_);
    const broker::BehaviourOffer offer{description.name, description.description, base::HostName(),
                                       static_cast<std::int32_t>(getpid()),
                                       description.time_managed};
    auto id = client_.Export(broker::AgentBehaviourFactoryType().name, reference,
                             broker::PropertiesOf(offer));
    if (!id) return base::Fail(id.error());
    offer_ = *std::move(id);
    return {};
  }

  const std::string& broker() const override { return client_.reference(); }

 private:
  const std::shared_ptr<sdk::SharedOrb> orb_;  // ends after the objects that use it
  broker::BrokerClient client_;
  const PortableServer::POA_var poa_;
  const PortableServer::Servant_var<sdk::BehaviourFactoryServant> servant_;
  const PortableServer::ObjectId_var id_;
  std::string offer_;
};

}  // namespace

base::Result<std::unique_ptr<OfferedBehaviour>> OfferedBehaviour::Offer(
    const std::string& broker, const BehaviourDescription& description, BehaviourFactory factory) {
  auto orb = sdk::SharedOrb::Towards(broker);
  if (!orb) return base::Fail(orb.error());
  auto client = broker::BrokerClient::Connect((*orb)->orb(), broker);
  if (!client) return base::Fail(client.error());
  if (auto ok = client->EnsureServiceType(broker::AgentBehaviourFactoryType()); !ok)
    return base::Fail(ok.error());
  auto offered =
      std::make_unique<ExportedBehaviour>(*std::move(orb), *std::move(client), std::move(factory));
  if (auto ok = offered->Export(description); !ok) return base::Fail(ok.error());
  return offered;
}

}  // namespace gsv
