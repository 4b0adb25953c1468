#include "gsv/broker/client/broker_administration.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <optional>
#include <ostream>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/client_errors.h"
#include "gsv/broker/client/corbaloc.h"
#include "gsv/broker/trader/service_reference.h"
#include "gsv/orb/orb.h"

namespace gsv::broker {
namespace {

using base::ErrorCode;
using Repository = CosTradingRepos::ServiceTypeRepository;

constexpr unsigned long kPingMs = 1000;
// number of links whose targets are called at the same time
constexpr std::uint32_t kAskedAtOnce = 16;

template <typename Interface>
typename Interface::_var_type Resolve(CORBA::ORB_ptr orb, const std::string& reference,
                                      std::chrono::milliseconds timeout) {
  const CORBA::Object_var object = orb->string_to_object(reference.c_str());
  omniORB::setClientCallTimeout(object, static_cast<unsigned long>(timeout.count()));
  typename Interface::_var_type narrowed = Interface::_narrow(object);
  if (!CORBA::is_nil(narrowed)) {
    omniORB::setClientCallTimeout(narrowed, static_cast<unsigned long>(timeout.count()));
  }
  return narrowed;
}

// Calls `call` with a reference to the broker's interface Lookup.
template <typename Call>
auto WithLookup(const std::string& broker, std::chrono::milliseconds timeout, const Call& call)
    -> decltype(call(CORBA::ORB_ptr(), CosTrading::Lookup_ptr())) {
  const auto reference = NormaliseReference(broker);
  if (!reference) return base::Fail(reference.error());
  const auto process = orb::CallingOrb();
  if (!process) return base::Fail(process.error());
  const CORBA::ORB_var& orb = *process;
  return Guarded(*reference, [&]() -> decltype(call(CORBA::ORB_ptr(), CosTrading::Lookup_ptr())) {
    const auto lookup = Resolve<CosTrading::Lookup>(orb, *reference, timeout);
    if (CORBA::is_nil(lookup)) {
      return base::Fail(ErrorCode::kUnavailable, "the object at this address is not a broker",
                        *reference);
    }
    return call(orb, lookup);
  });
}

// Calls `call` with a reference to the broker's interface Link.
template <typename Call>
auto WithLink(const std::string& broker, std::chrono::milliseconds timeout, const Call& call)
    -> decltype(call(CORBA::ORB_ptr(), CosTrading::Link_ptr())) {
  using Returned = decltype(call(CORBA::ORB_ptr(), CosTrading::Link_ptr()));
  return WithLookup(
      broker, timeout, [&](CORBA::ORB_ptr orb, CosTrading::Lookup_ptr lookup) -> Returned {
        const CosTrading::Link_var link = lookup->link_if();
        if (CORBA::is_nil(link)) {
          return base::Fail(ErrorCode::kUnavailable, "this broker does not support links", broker);
        }
        omniORB::setClientCallTimeout(link, static_cast<unsigned long>(timeout.count()));
        return call(orb, link);
      });
}

bool Answers(CosTrading::Lookup_ptr target) {
  try {
    omniORB::setClientCallTimeout(target, kPingMs);
    return !target->_non_existent();
  } catch (const CORBA::SystemException&) {
    return false;
  }
}

// Calls `work` with 0 … count-1, a few at a time. If a call throws an exception, it is rethrown
// here.
template <typename Work>
void ForEach(std::uint32_t count, const Work& work) {
  std::atomic<std::uint32_t> next = 0;
  std::vector<std::future<void>> workers;
  for (std::uint32_t i = 0; i < std::min(count, kAskedAtOnce); ++i) {
    workers.push_back(std::async(std::launch::async, [&] {
      for (std::uint32_t k = next++; k < count; k = next++) work(k);
    }));
  }
  for (auto& worker : workers) worker.wait();
  for (auto& worker : workers) worker.get();
}

// Returns the description of a link, or nullopt if the link was removed after its name was listed.
std::optional<LinkDescription> Describe(CORBA::ORB_ptr orb, CosTrading::Link_ptr link,
                                        const char* name) {
  try {
    const CosTrading::Link::LinkInfo_var info = link->describe_link(name);
    const CORBA::String_var ior = orb->object_to_string(info->target);
    const auto target = ReadReference(ior.in());
    return LinkDescription{.name = name,
                           .address = target ? target->Address() : std::string(),
                           .def_pass_on = static_cast<FollowOption>(info->def_pass_on_follow_rule),
                           .limiting = static_cast<FollowOption>(info->limiting_follow_rule),
                           .answers = Answers(info->target)};
  } catch (const CosTrading::Link::UnknownLinkName&) {
    return std::nullopt;
  }
}

}  // namespace

base::Result<std::vector<LinkDescription>> BrokerAdministration::ListLinks() const {
  using Links = base::Result<std::vector<LinkDescription>>;
  return WithLink(broker_, timeout_, [](CORBA::ORB_ptr orb, CosTrading::Link_ptr link) -> Links {
    const CosTrading::LinkNameSeq_var names = link->list_links();
    std::vector<std::optional<LinkDescription>> described(names->length());
    ForEach(names->length(),
            [&](std::uint32_t i) { described[i] = Describe(orb, link, names.in()[i]); });
    std::vector<LinkDescription> links;
    for (auto& each : described) {
      if (each) links.push_back(std::move(*each));
    }
    return links;
  });
}

base::Status BrokerAdministration::AddLink(const std::string& name, const std::string& target,
                                           FollowOption def_pass_on, FollowOption limiting) const {
  const auto reference = NormaliseReference(target);
  if (!reference) return base::Fail(reference.error());
  return WithLink(broker_, timeout_, [&](CORBA::ORB_ptr orb, CosTrading::Link_ptr link) {
    return Guarded(*reference, [&]() -> base::Status {
      const auto other = Resolve<CosTrading::Lookup>(orb, *reference, timeout_);
      if (CORBA::is_nil(other)) {
        return base::Fail(ErrorCode::kUnavailable, "the object at this address is not a broker",
                          *reference);
      }
      // The other trader returns its own reference, which may differ from the address in `target`.
      const CosTrading::Lookup_var itself = other->lookup_if();
      return Guarded(broker_, [&]() -> base::Status {
        link->add_link(name.c_str(), itself, static_cast<CosTrading::FollowOption>(def_pass_on),
                       static_cast<CosTrading::FollowOption>(limiting));
        return {};
      });
    });
  });
}

base::Status BrokerAdministration::RemoveLink(const std::string& name) const {
  return WithLink(broker_, timeout_,
                  [&](CORBA::ORB_ptr, CosTrading::Link_ptr link) -> base::Status {
                    link->remove_link(name.c_str());
                    return {};
                  });
}

base::Status BrokerAdministration::AddServiceType(const ServiceType& type) const {
  const auto orb = orb::CallingOrb();
  if (!orb) return base::Fail(orb.error());
  auto client = BrokerClient::Connect(*orb, broker_, timeout_);
  if (!client) return base::Fail(client.error());
  return client->EnsureServiceType(type);
}

base::Status BrokerAdministration::RemoveServiceType(const std::string& name) const {
  return WithLookup(
      broker_, timeout_, [&](CORBA::ORB_ptr, CosTrading::Lookup_ptr lookup) -> base::Status {
        const CORBA::Object_var object = lookup->type_repos();
        const Repository::_var_type types = Repository::_narrow(object);
        if (CORBA::is_nil(types)) {
          return base::Fail(ErrorCode::kUnavailable,
                            "this broker has no repository of service types", broker_);
        }
        types->remove_type(name.c_str());
        return {};
      });
}

base::Result<std::string> BrokerAdministration::AddOffer(
    const std::string& type, const std::string& reference,
    const std::vector<std::string>& properties) const {
  const auto orb = orb::CallingOrb();
  if (!orb) return base::Fail(orb.error());
  auto client = BrokerClient::Connect(*orb, broker_, timeout_);
  if (!client) return base::Fail(client.error());
  const auto declared = client->DescribeServiceType(type);
  if (!declared) return base::Fail(declared.error());
  std::vector<Property> values;
  for (const std::string& text : properties) {
    auto property = ParseProperty(text, *declared);
    if (!property) return base::Fail(property.error());
    values.push_back(std::move(*property));
  }
  try {
    const CORBA::Object_var object = (*orb)->string_to_object(reference.c_str());
    return client->Export(type, object, values);
  } catch (const CORBA::BAD_PARAM&) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "the reference of a service must begin with IOR: or corbaloc:", reference);
  }
}

base::Status BrokerAdministration::RemoveOffer(const std::string& id) const {
  const auto orb = orb::CallingOrb();
  if (!orb) return base::Fail(orb.error());
  auto client = BrokerClient::Connect(*orb, broker_, timeout_);
  if (!client) return base::Fail(client.error());
  return client->Withdraw(id);
}

std::string_view Spelling(FollowOption option) {
  switch (option) {
    case FollowOption::kLocalOnly:
      return "local_only";
    case FollowOption::kIfNoLocal:
      return "if_no_local";
    case FollowOption::kAlways:
      break;
  }
  return "always";
}

void PrintLinks(const std::vector<LinkDescription>& links, std::ostream& out) {
  for (const LinkDescription& link : links) {
    out << link.name << "  " << link.address << "  " << Spelling(link.def_pass_on) << ", at most "
        << Spelling(link.limiting) << (link.answers ? "" : "  (does not respond)") << "\n";
  }
}

void PrintLinksJson(const std::vector<LinkDescription>& links, std::ostream& out) {
  for (const LinkDescription& link : links) {
    const nlohmann::ordered_json line = {{"name", link.name},
                                         {"address", link.address},
                                         {"def_pass_on_follow_rule", Spelling(link.def_pass_on)},
                                         {"limiting_follow_rule", Spelling(link.limiting)},
                                         {"answers", link.answers}};
    out << line.dump() << "\n";
  }
}

}  // namespace gsv::broker
