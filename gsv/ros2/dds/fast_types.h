// A type of Fast DDS whose samples are bytes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <fastdds/dds/topic/TopicDataType.hpp>

namespace gsv::ros2::dds {

// A sample in two parts, as a writer takes it. So the pixels of an image are copied only once.
struct OutgoingSample {
  std::span<const std::byte> head;  // begins with the encapsulation header
  std::span<const std::byte> rest;
  std::size_t size() const { return head.size() + rest.size(); }
};

// A writer takes an OutgoingSample, a reader fills a std::vector<std::byte> with the encapsulation header.
class RawType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  RawType(const std::string& name, std::size_t max_size);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  // A sample above the maximum size, or without a header, becomes an empty one.
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override { return new std::vector<std::byte>; }
  void deleteData(void* data) override { delete static_cast<std::vector<std::byte>*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }

 private:
  const std::size_t max_size_;
};

}  // namespace gsv::ros2::dds
