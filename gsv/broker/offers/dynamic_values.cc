#include "gsv/broker/offers/dynamic_values.h"

#include <algorithm>

namespace gsv::broker {

DynamicValues::DynamicValues(DynamicEvaluator* evaluator, std::chrono::milliseconds budget)
    : evaluator_(evaluator), budget_(budget) {}

const Value* DynamicValues::FindStatic(const Offer& offer, std::string_view name) {
  constexpr std::size_t kPlaces = 16;
  const PropertyList& properties = offer.properties;
  auto place = std::find_if(places_.begin(), places_.end(),
                            [&](const Place& known) { return known.name == name; });
  if (place == places_.end()) {
    if (places_.size() == kPlaces) return properties.Find(name);
    place = places_.insert(place, Place{.name = std::string(name)});
  }
  if (place->names != properties.names()) {
    place->names = properties.names();
    place->index = properties.IndexOf(name);
  }
  return place->index < properties.size() ? &properties.values()[place->index] : nullptr;
}

const Value* DynamicValues::Find(const Offer& offer, std::string_view name) {
  const Value* value = FindStatic(offer, name);
  if (value == nullptr || !IsDynamic(*value)) return value;
  if (evaluator_ == nullptr) return nullptr;
  const auto [place, is_new] = known_.try_emplace(Key(offer.number, name));
  std::optional<Value>& known = place->second;
  if (is_new) {
    if (!deadline_) deadline_ = DynamicEvaluator::Clock::now() + budget_;
    if (slot_ != nullptr) slot_->Pause();
    known = evaluator_->Evaluate(place->first.second, *value->AsOther(), *deadline_);
    if (slot_ != nullptr) slot_->Resume();
  }
  return known ? &*known : nullptr;
}

bool IsDynamic(const Value& value) {
  const OtherValue* other = value.AsOther();
  return other != nullptr && other->promised_type != nullptr;
}

bool HasDynamicProperties(const Offer& offer) {
  const auto values = offer.properties.values();
  return std::any_of(values.begin(), values.end(), IsDynamic);
}

}  // namespace gsv::broker
