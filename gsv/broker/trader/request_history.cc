#include "gsv/broker/trader/request_history.h"

namespace gsv::broker {

RequestHistory::RequestHistory(std::size_t requests, std::chrono::nanoseconds lifetime, Clock clock)
    : requests_(requests), lifetime_(lifetime), clock_(std::move(clock)) {}

bool RequestHistory::Remember(const std::string& id) {
  const base::MutexLock lock(mutex_);
  const auto now = clock_();
  while (!by_age_.empty() && now - by_age_.front().first > lifetime_) ForgetOldest();
  const auto [place, is_new] = ids_.insert(id);
  if (!is_new) return false;
  by_age_.emplace_back(now, place);
  if (by_age_.size() > requests_) ForgetOldest();
  return true;
}

void RequestHistory::ForgetOldest() {
  ids_.erase(by_age_.front().second);
  by_age_.pop_front();
}

}  // namespace gsv::broker
