#include "gsv/ros2/types/service_names.h"

namespace gsv::ros2 {
namespace {

std::string HalfType(std::string_view type, std::string_view half) {
  const std::size_t slash = type.rfind('/');
  std::string name;
  for (const char c : type.substr(0, slash)) {
    if (c == '/') {
      name += "::";
    } else {
      name += c;
    }
  }
  return name.append("::dds_::").append(type.substr(slash + 1)).append(half);
}

}  // namespace

ServiceTopic RequestTopic(std::string_view service, std::string_view type) {
  return {"rq" + std::string(service) + "Request", HalfType(type, "_Request_")};
}

ServiceTopic ResponseTopic(std::string_view service, std::string_view type) {
  return {"rr" + std::string(service) + "Reply", HalfType(type, "_Response_")};
}

ServiceTopic ActionTopic(std::string_view topic, std::string_view type) {
  return {"rt" + std::string(topic), HalfType(type, "_")};
}

}  // namespace gsv::ros2
