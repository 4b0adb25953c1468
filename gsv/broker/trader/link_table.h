// The links to other traders, by name.
//
// Source   OMG Trading Object Service (formal/00-06-27), "Link".
// Errors   the errors of the standard, see Refusal. A refused call changes nothing.
// Threads  not safe; Trader serialises access.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gsv/broker/offers/import_policies.h"
#include "gsv/broker/offers/trading_error.h"

namespace gsv::broker {

struct TraderLink {
  std::string name{};
  std::string target{};  // the reference of the other trader's Lookup: "IOR:…"
  // The policy link_follow_rule of a query that is forwarded over this link, if the importer's
  // query does not set this policy.
  FollowOption def_pass_on = FollowOption::kAlways;
  // The most permissive rule that is allowed for this link.
  FollowOption limiting = FollowOption::kAlways;
};

class LinkTable {
 public:
  // `limit` is the maximum number of links.
  explicit LinkTable(std::size_t limit) : limit_(limit) {}

  // Adds a link. `bound` is the trader's max_link_follow_policy.
  TradingResult<void> Add(TraderLink link, FollowOption bound);
  // Changes the follow rules of a link. `bound` is as in Add().
  TradingResult<void> Modify(const std::string& name, FollowOption def_pass_on,
                             FollowOption limiting, FollowOption bound);
  TradingResult<void> Remove(const std::string& name);
  // Returns a link by its name.
  TradingResult<TraderLink> Describe(const std::string& name) const;
  // Returns all links, sorted by name.
  std::vector<TraderLink> All() const;
  // Adds a stored link without checks.
  void Restore(TraderLink link);

 private:
  // Returns an error if no link has this name.
  TradingResult<void> CheckKnown(const std::string& name) const;

  const std::size_t limit_;
  std::map<std::string, TraderLink> links_;
};

}  // namespace gsv::broker
