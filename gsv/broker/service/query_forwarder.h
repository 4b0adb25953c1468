// Forwards a query to other traders, to all at the same time, within the query's time limit. A
// trader that did not answer the last call is called by only one query at a time.
//
// Errors   a trader that does not answer, or refuses, contributes no offers. The class logs on
//          stderr when a trader becomes silent, and when it answers again.
// Threads  any; no lock is held during a call.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <COS/CosTrading.hh>

#include "gsv/base/mutex.h"
#include "gsv/broker/language/limits.h"
#include "gsv/broker/language/offer.h"

namespace gsv::broker {

// The properties of an offer that an importer requests.
struct DesiredProperties {
  bool all = false;                // whether all properties are requested
  std::vector<std::string> names;  // names of the requested properties, unless `all` is true
};

// The parts of a query that are equal for all traders.
struct ForwardedQuery {
  std::string type;  // name of the service type
  std::string preference;
  DesiredProperties desired;  // includes the properties that the preference needs
  std::size_t at_most = 0;    // the maximum number of offers from each trader
  // The query ends at this time, with or without answers.
  std::chrono::steady_clock::time_point deadline;
};

// A trader to which a query is forwarded, and the parts of the query that are specific to this
// trader.
struct QueryDestination {
  std::string name;                // the name in messages, such as "link north"
  std::string target;              // the trader's Lookup: "IOR:…"
  std::string constraint;          // the constraint for this trader; a proxy's recipe may change it
  CosTrading::PolicySeq policies;  // the policies for this trader
};

// The answer of one trader.
struct ForwardedAnswer {
  Offers offers{};
  std::vector<std::string> limits_applied{};  // names of the policies that limited the answer
  bool complete = false;                      // false if the trader did not answer all of the query
};

class QueryForwarder {
 public:
  explicit QueryForwarder(const FederationLimits& limits) : limits_(limits) {}

  // Returns when all traders have answered, or when the time is over. The answers are in the order
  // of `destinations`.
  std::vector<ForwardedAnswer> Ask(CORBA::ORB_ptr orb, const ForwardedQuery& query,
                                   const std::vector<QueryDestination>& destinations);

 private:
  // Calls one trader, and waits for its answer until the query's deadline.
  ForwardedAnswer AskOne(CORBA::ORB_ptr orb, const ForwardedQuery& query,
                         const QueryDestination& destination);
  // Returns false if the trader is silent and another query is calling it, or if too many calls are
  // in progress.
  bool Enter(const std::string& target);
  // Ends a call for which Enter() returned true, and notes whether the trader is silent.
  void Leave(const QueryDestination& destination, bool answered);

  const FederationLimits limits_;
  base::Mutex mutex_;
  std::size_t underway_ GSV_GUARDED_BY(mutex_) = 0;  // number of calls in progress
  std::map<std::string, bool> silent_
      GSV_GUARDED_BY(mutex_);  // silent traders, and whether a query calls them now
};

}  // namespace gsv::broker
