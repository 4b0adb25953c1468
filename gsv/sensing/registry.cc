#include "gsv/sensing/registry.h"

#include <fmt/format.h>

namespace gsv::sensing {

base::Status SensorRegistry::Add(SensorType type) {
  std::vector<std::string> names = type.aliases;
  names.push_back(type.name);
  for (const std::string& name : names) {
    if (name.empty() || types_.contains(name)) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        fmt::format("the sensor type {} cannot take the name \"{}\": {}", type.name,
                                    name, name.empty() ? "it is empty" : "another type has it"));
    }
  }
  const auto shared = std::make_shared<const SensorType>(std::move(type));
  for (const std::string& name : names) types_.emplace(name, shared);
  return {};
}

const SensorType* SensorRegistry::Find(std::string_view name) const {
  const auto it = types_.find(name);
  return it == types_.end() ? nullptr : it->second.get();
}

std::vector<std::string> SensorRegistry::names() const {
  std::vector<std::string> names;
  for (const auto& [name, type] : types_) {
    if (name == type->name) names.push_back(name);
  }
  return names;
}

}  // namespace gsv::sensing
