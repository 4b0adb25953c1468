#include "gsv/broker/trading_objects.h"

namespace gsv::broker {
namespace {

CursorLimits LimitsOfCursors(const TraderLimits& limits) {
  return {.cursors = limits.iterators,
          .entries = limits.offers_in_iterators,
          .lifetime = limits.iterator_lifetime};
}

}  // namespace

TradingObjects::TradingObjects(const TraderLimits& limits, std::uint32_t stem, std::uint64_t seed)
    : trader(limits, stem, seed),
      dynamic(limits.dynamic),
      offer_cursors(LimitsOfCursors(limits)),
      id_cursors(LimitsOfCursors(limits)) {}

}  // namespace gsv::broker
