// Asks other traders the query that came to this one: at the same time, each for as long as there
// is time, and no trader that is known to be silent by more than one query at once.
//
// Errors   a trader that does not answer, or refuses, has nothing to offer; the first silence of a
//          trader, and its end, are logged on stderr.
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

// Which properties of an offer an importer wants to see.
struct DesiredProperties {
  bool all = false;
  std::vector<std::string> names;
};

struct ForwardedQuery {
  std::string type;
  std::string preference;
  DesiredProperties desired;  // with those that the preference needs
  std::size_t at_most = 0;    // offers of each trader
  std::chrono::steady_clock::time_point deadline;
};

struct QueryDestination {
  std::string name;    // for people: "link north"
  std::string target;  // the trader's Lookup: "IOR:…"
  std::string constraint;
  CosTrading::PolicySeq policies;
};

struct ForwardedAnswer {
  Offers offers{};
  std::vector<std::string> limits_applied{};
  bool complete = false;  // false: the trader did not answer all of the query
};

class QueryForwarder {
 public:
  explicit QueryForwarder(const FederationLimits& limits) : limits_(limits) {}

  // Returns when all have answered, or the time is over. The answers in the order of
  // `destinations`.
  std::vector<ForwardedAnswer> Ask(CORBA::ORB_ptr orb, const ForwardedQuery& query,
                                   const std::vector<QueryDestination>& destinations);

 private:
  ForwardedAnswer AskOne(CORBA::ORB_ptr orb, const ForwardedQuery& query,
                         const QueryDestination& destination);
  // False: the trader is silent, and another query is asking it; or too many calls are underway.
  bool Enter(const std::string& target);
  void Leave(const QueryDestination& destination, bool answered);

  const FederationLimits limits_;
  base::Mutex mutex_;
  std::size_t underway_ GSV_GUARDED_BY(mutex_) = 0;
  std::map<std::string, bool> silent_
      GSV_GUARDED_BY(mutex_);  // by target: whether a query is asking it
};

}  // namespace gsv::broker
