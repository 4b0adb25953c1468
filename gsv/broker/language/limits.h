// Limits on untrusted input. docs/broker.md lists them with their reasons.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace gsv::broker {

// Limits on one constraint or preference.
struct ExpressionLimits {
  std::size_t length = 8192;  // in characters
  std::size_t depth = 64;     // levels of nested parentheses
  std::size_t nodes = 1000;   // number of operators, properties and literals
};

// Limits on dynamic properties.
struct DynamicLimits {
  std::chrono::milliseconds call_timeout{500};   // time limit of one evaluation
  std::chrono::milliseconds query_budget{2000};  // time limit of all evaluations of a query
  std::chrono::milliseconds lifetime{1000};  // how long a value or a failed evaluation is cached
  std::size_t value_bytes = 2048;  // maximum encoded size; a larger value counts as unavailable
  std::size_t per_offer = 8;       // maximum number of dynamic properties of an offer
  std::size_t answers = 10'000;    // number of cached values
};

// Limits on queries to other traders.
struct FederationLimits {
  // Time limit of one hop, from a trader to the next trader. A trader from which H hops remain
  // waits H times this limit. So each trader still has time to answer if the traders behind it do
  // not answer.
  std::chrono::milliseconds per_hop{500};
  std::size_t links = 100;       // maximum number of links of a trader
  std::size_t proxies = 16;      // maximum number of proxies that one query uses
  std::size_t trader_name = 32;  // maximum number of links named in one starting_trader or resolve
  std::size_t calls = 32;        // maximum number of calls in progress, summed over all queries
  std::size_t offers_per_answer = 20'000;    // maximum number of offers from one trader
  std::size_t bytes_per_answer = 16u << 20;  // maximum size of the offers from one trader
  // maximum number of remembered request ids; a query with a remembered id has come by another path
  // before, so its answer is empty
  std::size_t requests = 10'000;
  std::chrono::seconds request_lifetime{60};  // a request id is forgotten after this time
};

// The limits of a trader.
struct TraderLimits {
  ExpressionLimits expression;
  DynamicLimits dynamic{};
  FederationLimits federation{};
  std::size_t offers = 200'000;  // maximum number of offers in the trader, including proxy offers
  std::size_t properties_per_offer = 128;
  std::size_t offer_bytes = 32 * 1024;  // maximum size of encoded properties and reference
  // maximum total length of all type names, so that the answer of list_types fits into a message
  std::size_t type_names_bytes = 32 * 1024;
  std::size_t type_bytes = 32 * 1024;           // maximum size of a type with all that it inherits
  std::size_t super_types = 64;                 // maximum number of direct and indirect super types
  std::size_t iterators = 1000;                 // maximum number of open iterators
  std::size_t offers_in_iterators = 2'000'000;  // maximum number of offers in all open iterators
  std::chrono::seconds iterator_lifetime{60};   // an unused iterator is removed after this time
};

}  // namespace gsv::broker
