
#include <fmt/format.h>

#include "gsv/base/mutex.h"
#include "gsv/broker/offers/recipe.h"
#include "gsv/broker/trader/offer_rules.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {

TradingResult<std::string> Trader::ExportProxy(const std::string& type, std::string target,
                                               std::vector<Property> properties, ProxyPart part) {
  const auto described = TypeForExport(type);
  if (!described) return Refuse(described.error());
  auto checked =
      CheckExport(*described, std::move(properties), attributes().supports_dynamic_properties);
  if (!checked) return Refuse(checked.error());
  if (!IsRecipe(part.recipe, *checked)) {
    return Refuse({.refusal = Refusal::kIllegalRecipe, .name = part.recipe});
  }
  if (part.recipe.size() > limits_.expression.length) {
    return Refuse({.refusal = Refusal::kLimit,
                   .detail = fmt::format("a recipe can have at most {} characters",
                                         limits_.expression.length)});
  }
  if (part.recipe.size() + part.policies.size() > limits_.offer_bytes) {
    return Refuse({.refusal = Refusal::kLimit,
                   .detail = fmt::format("recipe and policies can have at most {} bytes together",
                                         limits_.offer_bytes)});
  }
  return Store({.type = type,
                .reference = std::move(target),
                .properties = std::move(*checked),
                .proxy = std::make_shared<const ProxyPart>(std::move(part))});
}

TradingResult<void> Trader::WithdrawProxy(const std::string& id) {
  return Change([&]() GSV_REQUIRES(mutex_) -> TradingResult<void> {
    const auto proxy = FindProxy(id);
    if (!proxy) return Refuse(proxy.error());
    Remove({(*proxy)->number});
    return {};
  });
}

TradingResult<OfferPtr> Trader::DescribeProxy(const std::string& id) const {
  const base::ReaderLock lock(mutex_);
  return FindProxy(id);
}

std::vector<std::string> Trader::ProxyIds() const {
  const base::ReaderLock lock(mutex_);
  std::vector<std::string> ids;
  for (const OfferPtr& offer : offers_.All()) {
    if (offer->proxy != nullptr) ids.push_back(IdOf(offer->number));
  }
  return ids;
}

TradingResult<OfferPtr> Trader::FindProxy(const std::string& id) const {
  auto offer = FindAny(id);
  if (offer && (*offer)->proxy == nullptr) {
    return Refuse({.refusal = Refusal::kNotProxyOfferId, .name = id});
  }
  return offer;
}

}  // namespace gsv::broker
