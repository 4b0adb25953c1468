// The Trading Service without CORBA: service types, offers, and the queries that find them.
//
// Source   OMG Trading Object Service (formal/00-06-27).
// Errors   the errors of the standard, see Refusal. A refused call changes nothing.
// Threads  every member may be called at any time. Queries run concurrently and evaluate their
//          constraint without a lock.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/broker/language/expression.h"
#include "gsv/broker/language/limits.h"
#include "gsv/broker/language/offer.h"
#include "gsv/broker/offers/dynamic_values.h"
#include "gsv/broker/offers/found_offers.h"
#include "gsv/broker/offers/import_policies.h"
#include "gsv/broker/offers/offer_store.h"
#include "gsv/broker/offers/preference_order.h"
#include "gsv/broker/offers/scan_slots.h"
#include "gsv/broker/offers/trading_error.h"
#include "gsv/broker/trader/journal.h"
#include "gsv/broker/trader/link_table.h"
#include "gsv/broker/trader/type_repository.h"

namespace gsv::broker {

struct Query {
  std::string type;  // name of the service type
  std::string constraint{};
  std::string preference{};
  ImportPolicies policies{};
};

// The results of a query before they are ordered and limited.
struct MatchingOffers {
  FoundOffers offers{};
  Offers proxies{};  // proxies of traders that may have offers for the query
  Preference preference{};
  std::vector<double> known{};  // see broker::Rank()
  Cardinalities cardinalities{};
  // Names of the policies that limited the result so far.
  std::vector<std::string> limits_applied{};
};

// The result of a query: ordered and limited.
struct QueryResult {
  FoundOffers offers{};
  // The names of the policies that limited the result.
  std::vector<std::string> limits_applied{};
};
// The result of a query whose offers are not sorted yet: the caller sorts as many as it needs.
struct RankedResult {
  RankedOffers offers{};
  std::vector<std::string> limits_applied{};  // names of the policies that limited the result
};

// The changes that Modify() makes to an offer.
struct Modification {
  std::vector<std::string> remove{};  // names of the properties to remove
  std::vector<Property> set{};        // properties to add, or to give a new value
};

class Trader {
 public:
  // `stem` is part of every offer's id, so that this trader recognises ids of other traders as
  // unknown. `seed` is the seed of the preference "random".
  Trader(const TraderLimits& limits, std::uint32_t stem, std::uint64_t seed);

  // Restores the state of an earlier trader, including its stem, and stores every later change in
  // `journal`. Call it before any other member, from one thread.
  // Errors  kCorrupt if the state contradicts itself.
  [[nodiscard]] base::Status Restore(TraderState state, std::unique_ptr<Journal> journal);

  // The number that is part of every offer's id, see the constructor.
  std::uint32_t stem() const { return stem_; }
  const TraderLimits& limits() const { return limits_; }
  TraderAttributes attributes() const;
  // `change` is called once, with the lock held.
  TradingResult<void> ChangeAttributes(const std::function<void(TraderAttributes&)>& change);

  // ---- Service types, see TypeRepository
  std::uint64_t NextIncarnation() const;
  TradingResult<std::uint64_t> AddType(ServiceType type);
  TradingResult<void> RemoveType(const std::string& name);
  std::vector<std::string> ListTypes(std::optional<std::uint64_t> since) const;
  TradingResult<ServiceType> DescribeType(const std::string& name) const;
  TradingResult<ServiceType> FullyDescribeType(const std::string& name) const;
  TradingResult<void> MaskType(const std::string& name);
  TradingResult<void> UnmaskType(const std::string& name);

  // ---- Offers

  // Returns the service type for an export. Fails if the type is unknown or masked.
  TradingResult<ServiceType> TypeForExport(const std::string& type) const;
  // Exports an offer without checking `reference`. Returns the offer's id.
  TradingResult<std::string> Export(const std::string& type, std::string reference,
                                    std::vector<Property> properties);
  // Exports an offer. `type` is the result of TypeForExport().
  TradingResult<std::string> Export(const ServiceType& type, std::string reference,
                                    std::vector<Property> properties);
  // Withdraws an offer.
  TradingResult<void> Withdraw(const std::string& id);
  // Returns an offer.
  TradingResult<OfferPtr> Describe(const std::string& id) const;
  // Changes the properties of an offer.
  TradingResult<void> Modify(const std::string& id, Modification modification);
  // Withdraws the offers that a query without policies finds. Returns their number.
  TradingResult<std::size_t> WithdrawMatching(const std::string& type,
                                              const std::string& constraint,
                                              DynamicEvaluator* evaluator = nullptr);
  // Withdraws the offers with these numbers, and ignores numbers of offers that no longer exist.
  // Returns the number of withdrawn offers.
  std::size_t WithdrawAll(const std::vector<std::uint64_t>& numbers);
  // Returns the ids of the offers in the order of export, without proxies.
  std::vector<std::string> OfferIds() const;
  Offers AllOffers() const;
  std::string IdOf(const Offer& offer) const { return IdOf(offer.number); }

  // ---- Proxy offers. The functions in the section "Offers" neither find nor change them.

  // Exports a proxy offer without checking `target`, the Lookup of another trader. Returns the
  // proxy's id.
  TradingResult<std::string> ExportProxy(const std::string& type, std::string target,
                                         std::vector<Property> properties, ProxyPart part);
  TradingResult<void> WithdrawProxy(const std::string& id);
  TradingResult<OfferPtr> DescribeProxy(const std::string& id) const;
  // Returns the ids of the proxies in the order of export.
  std::vector<std::string> ProxyIds() const;

  // ---- Links, see LinkTable
  TradingResult<void> AddLink(TraderLink link);
  TradingResult<void> RemoveLink(const std::string& name);
  TradingResult<TraderLink> DescribeLink(const std::string& name) const;
  TradingResult<void> ModifyLink(const std::string& name, FollowOption def_pass_on,
                                 FollowOption limiting);
  // Returns the links by name.
  std::vector<TraderLink> links() const;

  // Stores all acknowledged changes. Later changes are refused.
  void Close() {
    if (journal_ != nullptr) journal_->Close();
  }

  // ---- Queries

  // Queries search the offers of this trader only. FindMatching() finds the offers, and Rank()
  // orders and limits them. Find() calls both functions. A caller may call FindMatching() and
  // Rank() separately, and add offers of other traders in between.
  TradingResult<MatchingOffers> FindMatching(const Query& query, DynamicValues& values) const;
  RankedResult Rank(MatchingOffers matches, DynamicValues& values) const;
  TradingResult<QueryResult> Find(const Query& query, DynamicValues& values) const;
  // Runs a query in which dynamic properties have no value.
  TradingResult<QueryResult> Find(const Query& query) const;

 private:
  // Calls `apply` with the lock held. Returns when the changes that `apply` has recorded are
  // durable. Fails with kNotStored if the changes cannot be stored. Then they remain in memory, and
  // all later calls fail without calling `apply`.
  template <typename Apply>
  std::invoke_result_t<Apply> Change(const Apply& apply);
  // Appends a change to the journal, if there is one.
  void Record(StateChange change) GSV_REQUIRES(mutex_) {
    if (journal_ != nullptr) last_change_ = journal_->Append(std::move(change));
  }
  // Appends the present definition of a service type to the journal.
  void RecordType(const std::string& name) GSV_REQUIRES(mutex_);

  // The offers among which a query searches, and the limits of the search.
  struct Candidates;
  // The search of one query among the candidates.
  class Search;
  // `terms` are the equality terms of the query's constraint.
  Candidates SelectCandidates(const Query& query, const std::vector<EqualityTerm>& terms) const;
  // Makes indices for a query with these terms, see OfferStore::Index().
  void MakeIndex(const std::vector<std::string>& types,
                 const std::vector<EqualityTerm>& terms) const;
  // Returns the number in an offer's id. Fails if the text is not an id, or if its stem is that of
  // another trader.
  TradingResult<std::uint64_t> NumberOf(const std::string& id) const;
  // Returns the id of the offer with this number.
  std::string IdOf(std::uint64_t number) const;
  // Finds an offer or a proxy.
  TradingResult<OfferPtr> FindAny(const std::string& id) const GSV_REQUIRES_SHARED(mutex_);
  // FindOffer() fails if the offer is a proxy, and FindProxy() fails if it is not.
  TradingResult<OfferPtr> FindOffer(const std::string& id) const GSV_REQUIRES_SHARED(mutex_);
  TradingResult<OfferPtr> FindProxy(const std::string& id) const GSV_REQUIRES_SHARED(mutex_);
  // Checks the size, sets the offer's number, and stores it.
  TradingResult<std::string> Store(Offer offer);
  // Removes the offers with these numbers.
  void Remove(std::vector<std::uint64_t> numbers) GSV_REQUIRES(mutex_);
  // Returns an error if an offer with these properties and this reference exceeds the limits.
  TradingResult<void> CheckSize(const PropertyList& properties, const std::string& reference) const;

  const TraderLimits limits_;
  std::uint32_t stem_;                       // part of every offer's id
  std::unique_ptr<Journal> journal_;         // null if everything is in memory only
  mutable std::atomic<std::uint64_t> seed_;  // seed of the next query for the preference "random"
  // Limits the number of queries that scan many offers at the same time.
  mutable ScanSlots scan_slots_{ScanSlots::ForThisMachine()};
  mutable base::SharedMutex mutex_;
  TraderAttributes attributes_ GSV_GUARDED_BY(mutex_);
  TypeRepository types_ GSV_GUARDED_BY(mutex_);
  mutable OfferStore offers_ GSV_GUARDED_BY(mutex_);  // mutable, because a query may add an index
  LinkTable links_ GSV_GUARDED_BY(mutex_);
  Journal::ChangeNumber last_change_ GSV_GUARDED_BY(mutex_) = 0;  // the last recorded change
};

// A change is in the data file before its caller gets an answer. No thread holds the lock while it
// waits for the file, so that the changes of many callers become one transaction.
template <typename Apply>
std::invoke_result_t<Apply> Trader::Change(const Apply& apply) {
  const TradingError not_stored{.refusal = Refusal::kNotStored};
  if (journal_ != nullptr && !journal_->works()) return Refuse(not_stored);
  Journal::ChangeNumber number = 0;
  auto result = [&] {
    const base::WriterLock lock(mutex_);
    auto applied = apply();
    number = last_change_;
    return applied;
  }();
  if (journal_ != nullptr && result && !journal_->Wait(number)) return Refuse(not_stored);
  return result;
}

}  // namespace gsv::broker
