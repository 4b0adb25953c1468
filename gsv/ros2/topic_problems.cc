#include "gsv/ros2/topic_problems.h"

#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "gsv/ros2/names.h"
#include "gsv/ros2/types/type_hash.h"

namespace gsv::ros2 {
namespace {

// The properties of an endpoint that are compared. Many endpoints have the same properties.
struct Side {
  std::string type, hash;
  bool is_reliable = false, is_transient_local = false;
  friend auto operator<=>(const Side&, const Side&) = default;
};

struct Sides {
  std::set<Side> writers, readers;
};

Side SideOf(const dds::Topic& topic) {
  const std::string ros_type = RosTypeName(topic.type);
  return {ros_type.empty() ? topic.type : ros_type, std::string(TypeHashIn(topic.user_data)),
          topic.qos.is_reliable, topic.qos.is_transient_local};
}

void Compare(const std::string& topic, const Side& writer, const Side& reader,
             std::set<std::string>& problems) {
  if (writer.type != reader.type) {
    problems.insert(fmt::format(
        "{}: a publisher has type {}, a subscription {}. DDS delivers nothing between them. Change "
        "one of the nodes",
        topic, writer.type, reader.type));
    return;
  }
  if (!writer.hash.empty() && !reader.hash.empty() && writer.hash != reader.hash) {
    problems.insert(fmt::format(
        "{}: two nodes have different definitions of {}; the type hashes are {} and {}. "
        "Build both nodes with the same version of its package",
        topic, writer.type, writer.hash, reader.hash));
  }
  if (reader.is_reliable && !writer.is_reliable) {
    problems.insert(
        fmt::format("{}: a subscription requires reliable delivery, but a publisher offers "
                    "best effort, so no messages are delivered. Set the subscription's reliability "
                    "to best effort",
                    topic));
  }
  if (reader.is_transient_local && !writer.is_transient_local) {
    problems.insert(
        fmt::format("{}: a subscription requires transient local durability, but a publisher "
                    "offers volatile, so no messages are delivered. Set the subscription's "
                    "durability to volatile",
                    topic));
  }
}

}  // namespace

std::vector<std::string> FindTopicProblems(const std::vector<dds::Endpoint>& endpoints) {
  std::map<std::string, Sides> topics;
  for (const dds::Endpoint& endpoint : endpoints) {
    const std::string name = RosTopicName(endpoint.topic.name);
    if (name.empty()) continue;
    Sides& sides = topics[name];
    (endpoint.is_writer ? sides.writers : sides.readers).insert(SideOf(endpoint.topic));
  }
  std::set<std::string> problems;
  for (const auto& [topic, sides] : topics) {
    for (const Side& writer : sides.writers) {
      for (const Side& reader : sides.readers) Compare(topic, writer, reader, problems);
    }
  }
  return {problems.begin(), problems.end()};
}

}  // namespace gsv::ros2
