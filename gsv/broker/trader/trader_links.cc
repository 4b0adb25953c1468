
#include "gsv/base/mutex.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {

TradingResult<void> Trader::AddLink(TraderLink link) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
    auto added = links_.Add(link, attributes_.max_link_follow_policy);
    if (added) Record(LinkStored{link});
    return added;
  });
}

TradingResult<void> Trader::RemoveLink(const std::string& name) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
    auto removed = links_.Remove(name);
    if (removed) Record(LinkRemoved{name});
    return removed;
  });
}

TradingResult<void> Trader::ModifyLink(const std::string& name, FollowOption def_pass_on,
                                       FollowOption limiting) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
    auto modified = links_.Modify(name, def_pass_on, limiting, attributes_.max_link_follow_policy);
    if (modified) Record(LinkStored{*links_.Describe(name)});
    return modified;
  });
}

TradingResult<TraderLink> Trader::DescribeLink(const std::string& name) const {
  const base::ReaderLock lock(mutex_);
  return links_.Describe(name);
}

std::vector<TraderLink> Trader::links() const {
  const base::ReaderLock lock(mutex_);
  return links_.All();
}

}  // namespace gsv::broker
