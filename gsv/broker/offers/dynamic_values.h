// Dynamic properties: an offer says whom to ask for the value, a query asks.
//
// Source   OMG Trading Object Service (formal/00-06-27), "dynamic properties".
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gsv/broker/language/offer.h"
#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/scan_slots.h"

namespace gsv::broker {

// Threads  any.
class DynamicEvaluator {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~DynamicEvaluator() = default;
  // The value now, of the type that the property promises; nothing when it cannot be had by
  // `deadline`. `property` is dynamic.
  virtual std::optional<Value> Evaluate(const std::string& name, const OtherValue& property,
                                        Clock::time_point deadline) = 0;
};

// What one query sees of dynamic properties: each is asked for at most once, so that constraint,
// preference and answer agree, and only if it is needed. When the query's time is spent, those
// that are still unknown have no value.
//
// Threads  not safe; one query's own.
class DynamicValues {
 public:
  // Without an evaluator no dynamic property has a value.
  DynamicValues(DynamicEvaluator* evaluator, std::chrono::milliseconds budget);

  // Null, or whose turn is given up while a service is asked.
  void set_slot(ScanSlot* turn) { turn_ = turn; }

  // The property's value, asked for when it is dynamic. Null when there is none. The pointer holds
  // as long as this and the offer. It is found at once where offers that are asked for one after
  // the other have the same names of properties.
  const Value* Find(const Offer& offer, std::string_view name);

 private:
  using Key = std::pair<std::uint64_t, std::string>;
  // Where the property of a name stood last, in offers whose properties have these names.
  struct Place {
    std::string name;
    std::shared_ptr<const PropertyNames> names{};
    std::size_t index = 0;
  };

  const Value* FindStatic(const Offer& offer, std::string_view name);

  DynamicEvaluator* const evaluator_;
  ScanSlot* turn_ = nullptr;
  const std::chrono::milliseconds budget_;
  std::optional<DynamicEvaluator::Clock::time_point> deadline_;  // from the first question on
  std::map<Key, std::optional<Value>> known_;
  std::vector<Place> places_;
};

// An offer with its dynamic properties evaluated as needed.
class EvaluatedOffer : public PropertySource {
 public:
  EvaluatedOffer(const Offer& offer, DynamicValues& values) : offer_(offer), values_(values) {}
  const Value* Find(std::string_view name) const override { return values_.Find(offer_, name); }

 private:
  const Offer& offer_;
  DynamicValues& values_;
};

bool IsDynamic(const Value& value);
bool HasDynamicProperties(const Offer& offer);

}  // namespace gsv::broker
