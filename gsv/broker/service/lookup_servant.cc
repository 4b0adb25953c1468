#include "gsv/broker/service/lookup_servant.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <span>

#include "gsv/broker/encoding/corba_values.h"
#include "gsv/broker/language/names.h"
#include "gsv/broker/service/federated_query.h"
#include "gsv/broker/service/policy_values.h"
#include "gsv/broker/service/raise.h"
#include "gsv/broker/trader/iterator_keys.h"

namespace gsv::broker {
namespace {

DesiredProperties ToDesired(const CosTrading::Lookup::SpecifiedProps& props) {
  DesiredProperties desired;
  desired.all = props._d() == CosTrading::Lookup::all;
  if (props._d() != CosTrading::Lookup::some) return desired;
  std::set<std::string> seen;
  const CosTrading::PropertyNameSeq& names = props.prop_names();
  for (CORBA::ULong i = 0; i < names.length(); ++i) {
    const char* name = names[i];
    if (!IsIdentifier(name)) throw CosTrading::IllegalPropertyName(name);
    if (!seen.insert(name).second) throw CosTrading::DuplicatePropertyName(name);
    desired.names.emplace_back(name);
  }
  return desired;
}

bool IsDesired(const DesiredProperties& desired, const std::string& name) {
  return desired.all ||
         std::find(desired.names.begin(), desired.names.end(), name) != desired.names.end();
}

// Returns an upper bound of the encoded size of an offer whose dynamic properties are not evaluated
// yet. Each dynamic value has at most `dynamic_bytes`.
std::size_t EncodedSize(const Offer& offer, const DesiredProperties& desired,
                        std::size_t dynamic_bytes) {
  constexpr std::size_t kOverhead = 32;
  std::size_t size = kOverhead + offer.reference.size() / 2;
  if (!desired.all && desired.names.empty()) return size;
  size += offer.properties.EncodedSize();
  for (const Value& value : offer.properties.values()) {
    if (IsDynamic(value)) size += dynamic_bytes;
  }
  return size;
}

// Converts an offer and evaluates its dynamic properties. Omits each dynamic property whose value
// is not available.
CosTrading::Offer ToCorba(CORBA::ORB_ptr orb, const Offer& offer, const DesiredProperties& desired,
                          DynamicValues& values) {
  CosTrading::Offer result;
  result.reference = orb->string_to_object(offer.reference.c_str());
  CORBA::ULong count = 0;
  result.properties.length(static_cast<CORBA::ULong>(offer.properties.size()));
  for (const auto& [name, kept] : offer.properties) {
    if (!IsDesired(desired, name)) continue;
    const Value* value = IsDynamic(kept) ? values.Find(offer, name) : &kept;
    if (value == nullptr) continue;
    FillProperty(name, *value, result.properties[count++]);
  }
  result.properties.length(count);
  return result;
}

CosTrading::OfferSeq* ToCorba(CORBA::ORB_ptr orb, std::span<const OfferPtr* const> offers,
                              const DesiredProperties& desired, DynamicValues& values) {
  CosTrading::OfferSeq_var result = new CosTrading::OfferSeq;
  result->length(static_cast<CORBA::ULong>(offers.size()));
  for (CORBA::ULong i = 0; i < offers.size(); ++i) {
    result[i] = ToCorba(orb, **offers[i], desired, values);
  }
  return result._retn();
}

CosTrading::PolicyNameSeq* ToCorba(const std::vector<std::string>& names) {
  CosTrading::PolicyNameSeq_var result = new CosTrading::PolicyNameSeq;
  result->length(static_cast<CORBA::ULong>(names.size()));
  for (CORBA::ULong i = 0; i < names.size(); ++i) result[i] = names[i].c_str();
  return result._retn();
}

// Returns the time limit for evaluating dynamic properties. It is shorter for a query from another
// trader, because that trader waits for the answer.
std::chrono::milliseconds DynamicBudget(const TraderLimits& limits, const ImportPolicies& import) {
  if (!import.request_id) return limits.dynamic.query_budget;
  return std::min(limits.dynamic.query_budget, limits.federation.per_hop / 2);
}

// Calls `query`, which forwards the query to the trader in the policy starting_trader. If that
// trader is unavailable, this function throws TIMEOUT. After TRANSIENT or COMM_FAILURE, the
// client's ORB would repeat the call.
template <typename Call>
void QueryStartingTrader(const Call& query) {
  try {
    query();
  } catch (const CORBA::TRANSIENT&) {
    throw CORBA::TIMEOUT(0, CORBA::COMPLETED_NO);
  } catch (const CORBA::COMM_FAILURE&) {
    throw CORBA::TIMEOUT(0, CORBA::COMPLETED_MAYBE);
  }
}

}  // namespace

LookupServant::LookupServant(TradingObjects& objects)
    : ComponentsServant(objects), SupportServant(objects), ImportServant(objects.trader) {}

void LookupServant::query(const char* type, const char* constr, const char* pref,
                          const CosTrading::PolicySeq& policies,
                          const CosTrading::Lookup::SpecifiedProps& desired_props,
                          CORBA::ULong how_many, CosTrading::OfferSeq_out offers,
                          CosTrading::OfferIterator_out offer_itr,
                          CosTrading::PolicyNameSeq_out limits_applied) {
  const DesiredProperties desired = ToDesired(desired_props);
  const ImportPolicies import = ToImportPolicies(policies);
  if (!import.starting_trader.empty()) {
    const CosTrading::Lookup_var next = StartingTrader(objects_, import, policies);
    const TraderName rest(import.starting_trader.begin() + 1, import.starting_trader.end());
    const CosTrading::PolicySeq passed = PoliciesToPassOn(policies, {.starting_trader = rest});
    QueryStartingTrader([&] {
      next->query(type, constr, pref, passed, desired_props, how_many, offers, offer_itr,
                  limits_applied);
    });
    return;
  }
  const DynamicLimits& dynamic = objects_.trader.limits().dynamic;
  DynamicValues values(&objects_.dynamic, DynamicBudget(objects_.trader.limits(), import));
  FederatedQuery query{.query = {type, constr, pref, import},
                       .policies = policies,
                       .desired = desired,
                       .request_id = import.request_id.value_or(objects_.NewRequestId())};
  RankedResult result;
  if (objects_.requests.Remember(query.request_id)) {
    MatchingOffers matches = ValueOrRaise(objects_.trader.FindMatching(query.query, values));
    AddFederatedAnswers(objects_, query, matches, values);
    result = objects_.trader.Rank(std::move(matches), values);
  }

  const std::size_t count = std::min(how_many, objects_.trader.attributes().max_list);
  const std::vector<const OfferPtr*> first = result.offers.First(count);
  const std::size_t fitting = CountFitting(
      first, 0, count, kReplyBytes,
      [&](const OfferPtr* offer) { return EncodedSize(**offer, desired, dynamic.value_bytes); });
  CosTrading::OfferSeq_var first_offers = ToCorba(
      objects_.orb, std::span<const OfferPtr* const>(first).first(fitting), desired, values);
  CosTrading::OfferIterator_var rest;
  if (fitting != result.offers.size()) {
    const std::uint64_t key =
        objects_.offer_cursors.Open(RemainingOffers(std::move(result.offers), fitting), desired);
    const CORBA::Object_var iterator =
        IteratorReference(objects_.offer_iterators, key, CosTrading::OfferIterator::_PD_repoId);
    rest = CosTrading::OfferIterator::_unchecked_narrow(iterator);
  }
  limits_applied = ToCorba(result.limits_applied);
  offers = first_offers._retn();
  offer_itr = rest._retn();
}

CORBA::ULong OfferIteratorServant::max_left() {
  const auto left = objects_.offer_cursors.Left(CurrentIterator(objects_.orb));
  if (!left) throw CORBA::OBJECT_NOT_EXIST(0, CORBA::COMPLETED_NO);
  return static_cast<CORBA::ULong>(*left);
}

CORBA::Boolean OfferIteratorServant::next_n(CORBA::ULong n, CosTrading::OfferSeq_out offers) {
  const std::size_t count = std::min(n, objects_.trader.attributes().max_list);
  const DynamicLimits& dynamic = objects_.trader.limits().dynamic;
  const std::uint64_t key = CurrentIterator(objects_.orb);
  // Take() locks the table of all iterators. So the offers are sorted before Take(), and other
  // iterators need not wait. `remaining` keeps the offers alive.
  const auto remaining = objects_.offer_cursors.EntriesOf(key);
  if (!remaining) throw CORBA::OBJECT_NOT_EXIST(0, CORBA::COMPLETED_NO);
  remaining->Sorted();
  const auto batch = objects_.offer_cursors.Take(
      key, count, kReplyBytes, [&](const OfferPtr* offer, const DesiredProperties& desired) {
        return EncodedSize(**offer, desired, dynamic.value_bytes);
      });
  if (!batch) throw CORBA::OBJECT_NOT_EXIST(0, CORBA::COMPLETED_NO);
  DynamicValues values(&objects_.dynamic, dynamic.query_budget);
  offers = ToCorba(objects_.orb, batch->entries, batch->context, values);
  return batch->more;
}

void OfferIteratorServant::destroy() {
  if (!objects_.offer_cursors.Close(CurrentIterator(objects_.orb))) {
    throw CORBA::OBJECT_NOT_EXIST(0, CORBA::COMPLETED_NO);
  }
}

}  // namespace gsv::broker
