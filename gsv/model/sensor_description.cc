#include "gsv/model/sensor_description.h"

namespace gsv::model {
namespace {

template <typename T>
T ValueOr(const Parameters& parameters, const std::string& name, T otherwise) {
  const auto it = parameters.find(name);
  if (it == parameters.end()) return otherwise;
  const T* value = std::get_if<T>(&it->second);
  return value != nullptr ? *value : otherwise;
}

}  // namespace

double NumberOr(const Parameters& parameters, const std::string& name, double otherwise) {
  return ValueOr<double>(parameters, name, otherwise);
}

bool FlagOr(const Parameters& parameters, const std::string& name, bool otherwise) {
  return ValueOr<bool>(parameters, name, otherwise);
}

std::string TextOr(const Parameters& parameters, const std::string& name, std::string otherwise) {
  return ValueOr<std::string>(parameters, name, std::move(otherwise));
}

}  // namespace gsv::model
