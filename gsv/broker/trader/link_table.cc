#include "gsv/broker/trader/link_table.h"

#include <utility>

#include <fmt/format.h>

#include "gsv/broker/language/names.h"

namespace gsv::broker {
namespace {

TradingResult<void> CheckRules(FollowOption def_pass_on, FollowOption limiting,
                               FollowOption bound) {
  if (def_pass_on > limiting) {
    return Refuse({.refusal = Refusal::kDefaultFollowTooPermissive,
                   .follow = FollowConflict{def_pass_on, limiting}});
  }
  if (limiting > bound) {
    return Refuse({.refusal = Refusal::kLimitingFollowTooPermissive,
                   .follow = FollowConflict{limiting, bound}});
  }
  return {};
}

}  // namespace

TradingResult<void> LinkTable::Add(TraderLink link, FollowOption bound) {
  if (!IsIdentifier(link.name)) {
    return Refuse({.refusal = Refusal::kIllegalLinkName, .name = link.name});
  }
  if (links_.contains(link.name)) {
    return Refuse({.refusal = Refusal::kDuplicateLinkName, .name = link.name});
  }
  if (auto fits = CheckRules(link.def_pass_on, link.limiting, bound); !fits) return fits;
  if (links_.size() >= limit_) {
    return Refuse(
        {.refusal = Refusal::kLimit,
         .detail = fmt::format("the broker already has {} links, which is its limit", limit_)});
  }
  Restore(std::move(link));
  return {};
}

TradingResult<void> LinkTable::Modify(const std::string& name, FollowOption def_pass_on,
                                      FollowOption limiting, FollowOption bound) {
  if (auto known = CheckKnown(name); !known) return known;
  if (auto fits = CheckRules(def_pass_on, limiting, bound); !fits) return fits;
  TraderLink& link = links_.at(name);
  link.def_pass_on = def_pass_on;
  link.limiting = limiting;
  return {};
}

TradingResult<void> LinkTable::Remove(const std::string& name) {
  if (auto known = CheckKnown(name); !known) return known;
  links_.erase(name);
  return {};
}

TradingResult<TraderLink> LinkTable::Describe(const std::string& name) const {
  if (auto known = CheckKnown(name); !known) return Refuse(known.error());
  return links_.at(name);
}

std::vector<TraderLink> LinkTable::All() const {
  std::vector<TraderLink> all;
  for (const auto& [name, link] : links_) all.push_back(link);
  return all;
}

void LinkTable::Restore(TraderLink link) {
  std::string name = link.name;
  links_.insert_or_assign(std::move(name), std::move(link));
}

TradingResult<void> LinkTable::CheckKnown(const std::string& name) const {
  if (!IsIdentifier(name)) return Refuse({.refusal = Refusal::kIllegalLinkName, .name = name});
  if (!links_.contains(name)) return Refuse({.refusal = Refusal::kUnknownLinkName, .name = name});
  return {};
}

}  // namespace gsv::broker
