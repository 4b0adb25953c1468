#include "gsv/ros2/graph.h"

#include <algorithm>
#include <array>

#include "gsv/base/log.h"

namespace gsv::ros2 {
namespace {

void Write(const dds::Guid& guid, std::size_t size, messages::CdrWriter& writer) {
  std::array<std::uint8_t, 24> gid{};
  std::copy(guid.begin(), guid.end(), gid.begin());
  writer.WriteBlock(gid.data(), size, 1);
}

void Write(const std::vector<dds::Guid>& guids, std::size_t size, messages::CdrWriter& writer) {
  writer.WriteCount(guids.size());
  for (const dds::Guid& guid : guids) Write(guid, size, writer);
}

std::vector<dds::Guid> ReadGuids(std::size_t size, messages::CdrReader& reader) {
  std::vector<dds::Guid> guids(reader.ReadCount(size));
  for (dds::Guid& guid : guids) {
    std::array<std::uint8_t, 24> gid{};
    reader.ReadBlock(gid.data(), size, 1);
    std::copy_n(gid.begin(), guid.size(), guid.begin());
  }
  return guids;
}

base::Result<std::vector<NodeInfo>> DecodeGraphWith(std::size_t size,
                                                    std::span<const std::byte> sample) {
  // The minimum size of an encoded node, in bytes: two empty strings and two counts.
  constexpr std::size_t kMinNodeBytes = 16;
  messages::CdrReader reader(sample);
  std::array<std::uint8_t, 24> participant{};
  reader.ReadBlock(participant.data(), size, 1);
  std::vector<NodeInfo> nodes(reader.ReadCount(kMinNodeBytes));
  for (NodeInfo& node : nodes) {
    reader.Read(node.name_space);
    reader.Read(node.name);
    node.readers = ReadGuids(size, reader);
    node.writers = ReadGuids(size, reader);
  }
  if (auto ok = reader.Finish(); !ok) return base::Fail(ok.error());
  return nodes;
}

}  // namespace

base::Result<std::vector<NodeInfo>> DecodeGraph(std::span<const std::byte> sample) {
  auto nodes = DecodeGraphWith(16, sample);
  return nodes ? nodes : DecodeGraphWith(24, sample);
}

std::size_t GidSize(Distro distro) { return distro == Distro::kHumble ? 24 : 16; }

void EncodeGraph(const dds::Guid& participant, const std::vector<NodeInfo>& nodes, Distro distro,
                 messages::Bytes& out) {
  const std::size_t size = GidSize(distro);
  messages::CdrWriter writer(out);
  Write(participant, size, writer);
  writer.WriteCount(nodes.size());
  for (const NodeInfo& node : nodes) {
    writer.Write(node.name_space);
    writer.Write(node.name);
    Write(node.readers, size, writer);
    Write(node.writers, size, writer);
  }
}

Graph::Graph(dds::Participant& participant, Distro distro)
    : participant_(participant), distro_(distro) {
  auto writer = participant.MakeWriter({"ros_discovery_info",
                                        "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_",
                                        kLatchedQos,
                                        {}},
                                       {});
  if (writer) {
    writer_ = *std::move(writer);
  } else {
    spdlog::warn("ROS 2 nodes cannot be listed: {}", writer.error().Sentence());
  }
}

void Graph::Publish(const std::vector<NodeInfo>& nodes) {
  if (writer_ == nullptr || sent_ == nodes) return;
  messages::Bytes bytes;
  EncodeGraph(participant_.guid(), nodes, distro_, bytes);
  writer_->Write(bytes);
  sent_ = nodes;
}

}  // namespace gsv::ros2
