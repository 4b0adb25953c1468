// Publishes the list of nodes of this participant on the topic ros_discovery_info.
//
// Source  rmw_dds_common/msg/ParticipantEntitiesInfo.msg. Humble has one version of this file; Iron
//         and later distributions have another.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/messages/cdr.h"
#include "gsv/ros2/node.h"
#include "gsv/ros2/options.h"

namespace gsv::ros2 {

// Returns the number of bytes of a Gid: 24 in Humble, of which 16 are used, and 16 since Iron.
std::size_t GidSize(Distro distro);

// Encodes a ParticipantEntitiesInfo and appends it to `out`.
void EncodeGraph(const dds::Guid& participant, const std::vector<NodeInfo>& nodes, Distro distro,
                 messages::Bytes& out);

// Reads the nodes of a ParticipantEntitiesInfo of any distribution. `sample` is untrusted input.
base::Result<std::vector<NodeInfo>> DecodeGraph(std::span<const std::byte> sample);

// Publishes the nodes of one participant.
class Graph {
 public:
  // `participant` must outlive this object.
  Graph(dds::Participant& participant, Distro distro);
  // Sends the nodes if they have changed.
  void Publish(const std::vector<NodeInfo>& nodes);

 private:
  dds::Participant& participant_;
  const Distro distro_;
  // Null if the participant refused to create the writer; the refusal is logged.
  std::unique_ptr<dds::Writer> writer_;
  std::optional<std::vector<NodeInfo>> sent_;  // the nodes of the last message
};

}  // namespace gsv::ros2
