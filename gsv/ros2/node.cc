#include "gsv/ros2/node.h"

#include <utility>

#include "gsv/base/log.h"
#include "gsv/ros2/names.h"
#include "gsv/ros2/types/type_hash.h"

namespace gsv::ros2 {

Node::Node(dds::Participant& participant, Distro distro, std::string name_space, std::string name,
           std::function<void()> on_match)
    : participant_(participant),
      has_hashes_(distro != Distro::kHumble),
      on_match_(std::move(on_match)) {
  info_.name_space = std::move(name_space);
  info_.name = std::move(name);
}

dds::Topic Node::TopicFor(std::string_view topic, std::string_view type,
                          const dds::Qos& qos) const {
  const std::string whole =
      topic.starts_with('/') ? std::string(topic) : InNamespace(name_space(), topic);
  return {DdsTopicName(whole), DdsTypeName(type), qos,
          has_hashes_ ? TypeHashUserData(type) : std::string()};
}

dds::Writer* Node::Advertise(std::string_view topic, std::string_view type, const dds::Qos& qos) {
  auto writer = participant_.MakeWriter(TopicFor(topic, type, qos), on_match_);
  if (!writer) {
    spdlog::warn("no ROS 2 topic: {}", writer.error().Sentence());
    return nullptr;
  }
  info_.writers.push_back((*writer)->guid());
  writers_.push_back(*std::move(writer));
  return writers_.back().get();
}

dds::Reader* Node::Subscribe(std::string_view topic, std::string_view type, const dds::Qos& qos,
                             std::function<void(std::span<const std::byte>)> on_message) {
  auto reader = participant_.MakeReader(TopicFor(topic, type, qos), std::move(on_message));
  if (!reader) {
    spdlog::warn("no ROS 2 topic: {}", reader.error().Sentence());
    return nullptr;
  }
  info_.readers.push_back((*reader)->guid());
  readers_.push_back(*std::move(reader));
  return readers_.back().get();
}

}  // namespace gsv::ros2
