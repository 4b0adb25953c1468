#include "gsv/broker/service/query_forwarder.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <system_error>
#include <thread>

#include "gsv/broker/encoding/corba_values.h"
#include "gsv/broker/offers/dynamic_values.h"
#include "gsv/broker/trader/service_reference.h"

namespace gsv::broker {
namespace {

using CosTrading::Lookup;
using std::chrono::milliseconds;
using Deadline = std::chrono::steady_clock::time_point;

constexpr CORBA::ULong kForwardedBatch = 500;

// The first number for offers of other traders. The numbers of this trader's own offers begin at 1.
constexpr std::uint64_t kFirstForeignNumber = std::uint64_t{1} << 63;

// Limits the next call on `reference` to the remaining time. No other thread may use `reference`.
// Errors  throws CORBA::TIMEOUT if no time remains.
void LimitCall(CORBA::Object_ptr reference, Deadline deadline) {
  const auto left =
      std::chrono::duration_cast<milliseconds>(deadline - std::chrono::steady_clock::now());
  if (left <= milliseconds::zero()) throw CORBA::TIMEOUT(0, CORBA::COMPLETED_NO);
  omniORB::setClientCallTimeout(reference, static_cast<unsigned long>(left.count()));
}

Lookup::SpecifiedProps ToCorba(const DesiredProperties& desired) {
  Lookup::SpecifiedProps props;
  if (desired.all) {
    props._d(Lookup::all);
    return props;
  }
  CosTrading::PropertyNameSeq names;
  names.length(static_cast<CORBA::ULong>(desired.names.size()));
  for (CORBA::ULong i = 0; i < names.length(); ++i) names[i] = desired.names[i].c_str();
  props.prop_names(names);
  return props;
}

// Converts properties from another trader, which may send a name twice: then the last value
// applies. The other trader has already evaluated dynamic properties. A property that is still
// dynamic is omitted.
PropertyList PropertiesOf(const CosTrading::PropertySeq& properties) {
  std::vector<Property> taken = ToProperties(properties);
  std::erase_if(taken, [](const Property& property) { return IsDynamic(property.value); });
  return PropertyList::LastOfEachName(std::move(taken));
}

// Collects the answers of another trader up to the limit.
class Collector {
 public:
  Collector(CORBA::ORB_ptr orb, std::size_t offers, std::size_t bytes)
      : orb_(orb), offers_left_(offers), bytes_left_(bytes) {}

  bool full() const { return offers_left_ == 0 || bytes_left_ == 0; }
  // Whether offers were dropped because of the limit.
  bool cut() const { return cut_; }

  void Take(const CosTrading::OfferSeq& offers, bool more, Offers& taken) {
    CORBA::ULong i = 0;
    for (; i < offers.length() && !full(); ++i) {
      const CORBA::String_var ior = orb_->object_to_string(offers[i].reference);
      Offer offer{.number = kFirstForeignNumber,
                  .type = {},
                  .reference = ior.in(),
                  .properties = PropertiesOf(offers[i].properties)};
      bytes_left_ -= std::min(bytes_left_, offer.reference.size() + offer.properties.EncodedSize());
      --offers_left_;
      taken.push_back(std::make_shared<const Offer>(std::move(offer)));
    }
    cut_ = i < offers.length() || (more && full());
  }

 private:
  const CORBA::ORB_ptr orb_;
  std::size_t offers_left_;
  std::size_t bytes_left_;
  bool cut_ = false;
};

void TakeRest(CosTrading::OfferIterator_ptr rest, Deadline deadline, Collector& collector,
              Offers& taken) {
  CosTrading::OfferSeq_var offers;
  for (bool more = true; more && !collector.full();) {
    LimitCall(rest, deadline);
    more = rest->next_n(kForwardedBatch, offers) && offers->length() > 0;
    collector.Take(offers, more, taken);
  }
  LimitCall(rest, deadline);
  rest->destroy();
}

}  // namespace

std::vector<ForwardedAnswer> QueryForwarder::Ask(
    CORBA::ORB_ptr orb, const ForwardedQuery& query,
    const std::vector<QueryDestination>& destinations) {
  std::vector<ForwardedAnswer> answers(destinations.size());
  std::vector<std::jthread> threads;
  const auto ask = [&](std::size_t i) { answers[i] = AskOne(orb, query, destinations[i]); };
  for (std::size_t i = 1; i < destinations.size(); ++i) {
    try {
      threads.emplace_back(ask, i);
    } catch (const std::system_error&) {
      break;  // there is no memory for another thread, so the remaining traders count as silent
    }
  }
  if (!destinations.empty()) ask(0);
  threads.clear();
  return answers;
}

ForwardedAnswer QueryForwarder::AskOne(CORBA::ORB_ptr orb, const ForwardedQuery& query,
                                       const QueryDestination& destination) {
  ForwardedAnswer answer;
  if (!Enter(destination.target)) return answer;
  bool answered = true;
  try {
    const CORBA::Object_var object = orb->string_to_object(destination.target.c_str());
    const CosTrading::Lookup_var lookup = Lookup::_unchecked_narrow(object);
    const std::size_t most = std::min(query.at_most, limits_.offers_per_answer);
    Collector collector(orb, most, limits_.bytes_per_answer);
    CosTrading::OfferSeq_var offers;
    CosTrading::OfferIterator_var rest;
    CosTrading::PolicyNameSeq_var limits_applied;
    LimitCall(lookup, query.deadline);
    lookup->query(query.type.c_str(), destination.constraint.c_str(), query.preference.c_str(),
                  destination.policies, ToCorba(query.desired),
                  static_cast<CORBA::ULong>(std::min<std::size_t>(most, kForwardedBatch)), offers,
                  rest, limits_applied);
    for (CORBA::ULong i = 0; i < limits_applied->length(); ++i) {
      answer.limits_applied.emplace_back(limits_applied[i]);
    }
    collector.Take(offers, !CORBA::is_nil(rest), answer.offers);
    if (!CORBA::is_nil(rest)) TakeRest(rest, query.deadline, collector, answer.offers);
    if (collector.cut()) answer.limits_applied.emplace_back("return_card");
    answer.complete = true;
  } catch (const CORBA::UserException&) {
    // The trader does not know the type, or a property of the constraint. So it has no matching
    // offers.
    answer.complete = true;
  } catch (const CORBA::SystemException&) {
    answered = false;
  } catch (const std::exception&) {
    answered = false;
  }
  Leave(destination, answered);
  return answer;
}

bool QueryForwarder::Enter(const std::string& target) {
  const base::MutexLock lock(mutex_);
  if (underway_ >= limits_.calls) return false;
  const auto silent = silent_.find(target);
  if (silent != silent_.end()) {
    if (silent->second) return false;
    silent->second = true;
  }
  ++underway_;
  return true;
}

void QueryForwarder::Leave(const QueryDestination& destination, bool answered) {
  bool was_silent = false;
  {
    const base::MutexLock lock(mutex_);
    --underway_;
    was_silent = silent_.contains(destination.target);
    if (answered) {
      silent_.erase(destination.target);
    } else {
      if (!was_silent && silent_.size() >= limits_.links) silent_.clear();
      silent_[destination.target] = false;
    }
  }
  if (was_silent != answered) return;
  const auto parts = ReadReference(destination.target);
  const std::string address = parts ? parts->Address() : "an address that cannot be read";
  std::fprintf(stderr, "broker: %s, the trader at %s, %s\n", destination.name.c_str(),
               address.c_str(),
               answered ? "answers again" : "does not respond; queries continue without it");
}

}  // namespace gsv::broker
