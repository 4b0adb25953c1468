#include "gsv/ros2/graph.h"

#include <gtest/gtest.h>

namespace gsv::ros2 {
namespace {

// Returns the encoded size of a graph with one node "gsv" in "/" and one writer. `gid` is the
// number of bytes of a Gid.
std::size_t SizeFor(std::size_t gid) {
  // The summands: encapsulation, Gid, number of nodes; "/" and padding, "gsv", two counts, one Gid.
  return 4 + gid + 4 + (4 + 2 + 2) + (4 + 4) + 4 + 4 + gid;
}

TEST(RosGraph, HasGidsOfTheSizeOfTheDistribution) {
  const std::vector<NodeInfo> nodes{{"/", "gsv", {}, {dds::Guid{1}}}};
  messages::Bytes humble, jazzy;
  EncodeGraph({7}, nodes, Distro::kHumble, humble);
  EncodeGraph({7}, nodes, Distro::kJazzy, jazzy);
  EXPECT_EQ(humble.size(), SizeFor(24));
  EXPECT_EQ(jazzy.size(), SizeFor(16));
  EXPECT_EQ(jazzy[4], std::byte{7});
  EXPECT_EQ(jazzy[jazzy.size() - 16], std::byte{1});
}

TEST(RosGraph, IsReadBackUnchanged) {
  const std::vector<NodeInfo> nodes{{"/", "gsv", {dds::Guid{1, 2}}, {dds::Guid{3}}},
                                    {"/pebble", "robot", {}, {dds::Guid{4}, dds::Guid{5}}}};
  for (const Distro distro : {Distro::kHumble, Distro::kJazzy}) {
    messages::Bytes bytes;
    EncodeGraph({7}, nodes, distro, bytes);
    const auto read = DecodeGraph(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, nodes);
    EXPECT_FALSE(DecodeGraph(std::span(bytes).first(bytes.size() - 8)));
  }
}

TEST(RosGraph, ListsNodesByNamespaceAndName) {
  messages::Bytes bytes;
  EncodeGraph({}, {{"/pebble", "robot", {dds::Guid{2}}, {}}}, Distro::kJazzy, bytes);
  messages::CdrReader reader(bytes);
  dds::Guid guid{};
  std::string name_space, name;
  reader.ReadBlock(guid.data(), guid.size(), 1);
  EXPECT_EQ(reader.ReadCount(1), 1u);
  reader.Read(name_space);
  reader.Read(name);
  EXPECT_EQ(name_space, "/pebble");
  EXPECT_EQ(name, "robot");
  EXPECT_EQ(reader.ReadCount(16), 1u);
  reader.ReadBlock(guid.data(), guid.size(), 1);
  EXPECT_EQ(guid, dds::Guid{2});
  EXPECT_EQ(reader.ReadCount(16), 0u);
  EXPECT_TRUE(reader.Finish());
}

}  // namespace
}  // namespace gsv::ros2
