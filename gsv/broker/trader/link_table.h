// The links to other traders, by name.
//
// Source   OMG Trading Object Service (formal/00-06-27), "Link".
// Errors   those of the standard, see Refusal. What is refused changes nothing.
// Threads  not safe; Trader serialises.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gsv/broker/offers/import_policies.h"
#include "gsv/broker/offers/trading_error.h"

namespace gsv::broker {

struct TraderLink {
  std::string name{};
  std::string target{};  // the other trader's Lookup: "IOR:…"
  // What is asked of the other trader when the importer says nothing of links.
  FollowOption def_pass_on = FollowOption::kAlways;
  // The most that is done with this link.
  FollowOption limiting = FollowOption::kAlways;
};

class LinkTable {
 public:
  explicit LinkTable(std::size_t limit) : limit_(limit) {}

  // `most` is the trader's max_link_follow_policy.
  TradingResult<void> Add(TraderLink link, FollowOption most);
  TradingResult<void> Modify(const std::string& name, FollowOption def_pass_on,
                             FollowOption limiting, FollowOption most);
  TradingResult<void> Remove(const std::string& name);
  TradingResult<TraderLink> Describe(const std::string& name) const;
  // In the order of their names.
  std::vector<TraderLink> All() const;
  // Puts back a link that was taken once.
  void Restore(TraderLink link);

 private:
  TradingResult<void> CheckKnown(const std::string& name) const;

  const std::size_t limit_;
  std::map<std::string, TraderLink> links_;
};

}  // namespace gsv::broker
