// Dynamic properties. An offer refers to a service that computes the value, and a query calls the
// service.
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

// Gets the values of dynamic properties from the services that compute them. Any thread may use it.
class DynamicEvaluator {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~DynamicEvaluator() = default;
  // Returns the current value, which has the property's declared type, or nullopt if it is not
  // available by `deadline`. `property` is dynamic.
  virtual std::optional<Value> Evaluate(const std::string& name, const OtherValue& property,
                                        Clock::time_point deadline) = 0;
};

// The values of dynamic properties in one query. Each property is evaluated at most once, and only
// if its value is needed. So the constraint, the preference and the answer use the same value. When
// the query's time is over, properties that were not evaluated have no value.
//
// Threads  not safe; each query has its own.
class DynamicValues {
 public:
  // If `evaluator` is null, dynamic properties have no value.
  DynamicValues(DynamicEvaluator* evaluator, std::chrono::milliseconds budget);

  // Sets the slot that is released during calls to services, or null for none.
  void set_slot(ScanSlot* slot) { slot_ = slot; }

  // Returns the property's value, or null if there is none. Evaluates dynamic properties. The
  // pointer is valid as long as this object and the offer. The search is fast if successive offers
  // have the same property names.
  const Value* Find(const Offer& offer, std::string_view name);

 private:
  using Key = std::pair<std::uint64_t, std::string>;  // number of an offer, name of a property
  // The index at which this property was found last, for offers with these property names.
  struct Place {
    std::string name;
    Interned<PropertyNames> names{};
    std::size_t index = 0;
  };

  // Returns the property as the offer stores it, without an evaluation.
  const Value* FindStatic(const Offer& offer, std::string_view name);

  DynamicEvaluator* const evaluator_;
  ScanSlot* slot_ = nullptr;
  const std::chrono::milliseconds budget_;  // time limit of all evaluations of the query
  std::optional<DynamicEvaluator::Clock::time_point> deadline_;  // set by the first evaluation
  std::map<Key, std::optional<Value>> known_;  // results of the evaluations so far
  std::vector<Place> places_;                  // places of the properties that were searched
};

// An offer as a source of properties: dynamic properties are evaluated when they are needed.
class EvaluatedOffer : public PropertySource {
 public:
  EvaluatedOffer(const Offer& offer, DynamicValues& values) : offer_(offer), values_(values) {}
  const Value* Find(std::string_view name) const override { return values_.Find(offer_, name); }

 private:
  const Offer& offer_;
  DynamicValues& values_;
};

// Whether the value refers to a service that computes the property's value.
bool IsDynamic(const Value& value);
bool HasDynamicProperties(const Offer& offer);

}  // namespace gsv::broker
