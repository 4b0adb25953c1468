#include "gsv/formats/xacro/scope.h"

namespace gsv::formats::xacro {

void Scope::Set(const std::string& name, const Value& value, const NodePtr& at, bool is_lazy) {
  const auto* text = value.as<std::string>();
  Property property{text == nullptr ? value : FromLiteral(*text), at, false, false};
  property.is_lazy = is_lazy && property.value.as<std::string>() != nullptr;
  properties_[name] = std::move(property);
}

bool Scope::Has(const std::string& name) const {
  return properties_.contains(name) || (parent_ != nullptr && parent_->Has(name));
}

base::Result<std::optional<Value>> Scope::Find(const std::string& name) {
  const auto it = properties_.find(name);
  if (it == properties_.end()) {
    if (parent_ != nullptr) return parent_->Find(name);
    return std::nullopt;
  }
  Property& property = it->second;
  if (!property.is_lazy) return property.value;
  if (property.is_resolving) {
    return base::Fail(base::ErrorCode::kBadModel,
                      "the property \"" + name + "\" is defined by itself",
                      property.defined_at->place());
  }
  property.is_resolving = true;
  const std::string text = *property.value.as<std::string>();
  auto value = resolve_(text, *property.defined_at, *this);
  property.is_resolving = false;
  if (!value) return base::Fail(value.error());
  const auto* resolved = value->as<std::string>();
  property.value = resolved == nullptr ? *value : FromLiteral(*resolved);
  property.is_lazy = false;
  return property.value;
}

std::optional<Value> Scope::Member(const std::string& name) const {
  // Evaluating a lazy property stores its value, so Find() is not const. The value does not depend
  // on the time of evaluation.
  auto found = const_cast<Scope*>(this)->Find(name);
  return found ? *found : std::nullopt;
}

const Block* Scope::FindBlock(const std::string& name) const {
  const auto it = blocks_.find(name);
  if (it != blocks_.end()) return &it->second;
  return parent_ == nullptr ? nullptr : parent_->FindBlock(name);
}

std::pair<const Macro*, Space*> Space::FindMacro(const std::string& name) {
  const auto it = macros.find(name);
  if (it != macros.end()) return {&it->second, this};
  const std::size_t dot = name.find('.');
  if (dot != std::string::npos) {
    const auto space = spaces.find(name.substr(0, dot));
    if (space != spaces.end()) return space->second->FindMacro(name.substr(dot + 1));
  }
  return outer == nullptr ? std::pair<const Macro*, Space*>() : outer->FindMacro(name);
}

}  // namespace gsv::formats::xacro
