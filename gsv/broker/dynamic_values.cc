#include "gsv/broker/dynamic_values.h"

#include <algorithm>

namespace gsv::broker {

DynamicValues::DynamicValues(DynamicEvaluator* evaluator, std::chrono::milliseconds budget)
    : evaluator_(evaluator), budget_(budget) {}

const Value* DynamicValues::FindStatic(const Offer& offer, std::string_view name) {
  constexpr std::size_t kPlaces = 16;
  const std::vector<Property>& properties = offer.properties.all();
  auto place = std::find_if(places_.begin(), places_.end(),
                            [&](const Place& known) { return known.name == name.data(); });
  if (place != places_.end() && place->index < properties.size() &&
      properties[place->index].name == name) {
    return &properties[place->index].value;
  }
  const Value* value = offer.properties.Find(name);
  if (value == nullptr) return nullptr;
  std::size_t index = 0;
  while (&properties[index].value != value) ++index;
  if (place != places_.end()) {
    place->index = index;
  } else if (places_.size() < kPlaces) {
    places_.push_back({name.data(), index});
  }
  return value;
}

const Value* DynamicValues::Find(const Offer& offer, std::string_view name) {
  const Value* value = FindStatic(offer, name);
  if (value == nullptr || !IsDynamic(*value)) return value;
  if (evaluator_ == nullptr) return nullptr;
  const auto [place, is_new] = known_.try_emplace(Key(offer.number, name));
  std::optional<Value>& known = place->second;
  if (is_new) {
    if (!deadline_) deadline_ = DynamicEvaluator::Clock::now() + budget_;
    if (turn_ != nullptr) turn_->Pause();
    known = evaluator_->Evaluate(place->first.second, *value->AsOther(), *deadline_);
    if (turn_ != nullptr) turn_->Resume();
  }
  return known ? &*known : nullptr;
}

bool IsDynamic(const Value& value) {
  const OtherValue* other = value.AsOther();
  return other != nullptr && other->promised_type != nullptr;
}

bool HasDynamicProperties(const Offer& offer) {
  const std::vector<Property>& properties = offer.properties.all();
  return std::any_of(properties.begin(), properties.end(),
                     [](const Property& property) { return IsDynamic(property.value); });
}

}  // namespace gsv::broker
