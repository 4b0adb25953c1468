// A Fast DDS data type whose samples are sequences of bytes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <fastdds/dds/topic/TopicDataType.hpp>

namespace gsv::ros2::dds {

// An outgoing sample in two parts, so that the pixels of an image are copied only once.
struct OutgoingSample {
  std::span<const std::byte> head;  // begins with the encapsulation header
  std::span<const std::byte> rest;  // the bytes after `head`; may be empty
  std::size_t size() const { return head.size() + rest.size(); }
};

// A writer sends an OutgoingSample. A reader fills a std::vector<std::byte> that begins with the
// encapsulation header.
class RawType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  RawType(const std::string& name, std::size_t max_size);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  // Makes an empty sample if the payload exceeds the maximum size or has no header.
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override { return new std::vector<std::byte>; }
  void deleteData(void* data) override { delete static_cast<std::vector<std::byte>*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }

 private:
  const std::size_t max_size_;
};

}  // namespace gsv::ros2::dds
