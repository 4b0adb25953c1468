#include "gsv/broker/service/trading_objects.h"

#include <utility>

#include <fmt/format.h>

namespace gsv::broker {
namespace {

CursorLimits LimitsOfCursors(const TraderLimits& limits) {
  return {.cursors = limits.iterators,
          .entries = limits.offers_in_iterators,
          .lifetime = limits.iterator_lifetime};
}

}  // namespace

RemainingOffers::RemainingOffers(RankedOffers offers, std::size_t replied)
    : first_(replied), size_(offers.size() - replied), shared_(std::make_shared<Shared>()) {
  offers.ReleaseViews();
  shared_->offers = std::move(offers);
}

const FoundOffers& RemainingOffers::Sorted() const {
  std::call_once(shared_->once, [&] {
    shared_->sorted = std::move(shared_->offers).Sorted();
    shared_->offers = {};
  });
  return shared_->sorted;
}

TradingObjects::TradingObjects(const TraderLimits& limits, std::uint32_t stem, std::uint64_t seed)
    : trader(limits, stem, seed),
      dynamic(limits.dynamic),
      forwarder(limits.federation),
      requests(limits.federation.requests, limits.federation.request_lifetime),
      offer_cursors(LimitsOfCursors(limits)),
      id_cursors(LimitsOfCursors(limits)),
      process_(fmt::format("{:016x}", seed)) {}

std::string TradingObjects::NewRequestId() {
  return fmt::format("{}{}{:016x}", trader.attributes().request_id_stem, process_, next_request_++);
}

}  // namespace gsv::broker
