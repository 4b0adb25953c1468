#include "gsv/ros2/dds/fast_types.h"

#include <cstring>

namespace gsv::ros2::dds {
namespace {

constexpr std::uint32_t kHeader = 4;  // size of the encapsulation header, bytes

}  // namespace

RawType::RawType(const std::string& name, std::size_t max_size) : max_size_(max_size) {
  setName(name.c_str());
  m_typeSize = kHeader;
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool RawType::serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) {
  const auto& sample = *static_cast<const OutgoingSample*>(data);
  if (sample.head.size() < kHeader || sample.size() > payload->max_size) return false;
  std::memcpy(payload->data, sample.head.data(), sample.head.size());
  if (!sample.rest.empty()) {
    std::memcpy(payload->data + sample.head.size(), sample.rest.data(), sample.rest.size());
  }
  payload->length = static_cast<std::uint32_t>(sample.size());
  payload->encapsulation = CDR_LE;
  return true;
}

bool RawType::deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) {
  auto& sample = *static_cast<std::vector<std::byte>*>(data);
  sample.clear();
  if (payload->length < kHeader || payload->length > max_size_) return true;
  const auto* bytes = reinterpret_cast<const std::byte*>(payload->data);
  sample.assign(bytes, bytes + payload->length);
  return true;
}

std::function<std::uint32_t()> RawType::getSerializedSizeProvider(void* data) {
  const auto size = static_cast<const OutgoingSample*>(data)->size();
  return [size] { return static_cast<std::uint32_t>(size); };
}

}  // namespace gsv::ros2::dds
