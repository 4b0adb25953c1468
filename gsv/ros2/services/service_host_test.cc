#include "gsv/ros2/services/service_host.h"

#include <future>
#include <map>

#include <gtest/gtest.h>

#include "gsv/messages/simulation_interfaces.h"
#include "gsv/ros2/services/testing/fake_participant.h"

namespace gsv::ros2 {
namespace {

using messages::simulation_interfaces::DeleteEntityRequest;
using messages::simulation_interfaces::DeleteEntityResponse;

using testing::FakeParticipant;
using testing::kCycloneClient;
using testing::kFastClient;
using testing::Reply;

// A service that returns the name of the entity as its error message.
class ServiceHostTest : public ::testing::Test {
 protected:
  ServiceHostTest() : host_(participant_, true) {
    host_.Offer<DeleteEntityRequest>("/gsv/delete_entity", "simulation_interfaces/srv/DeleteEntity",
                                     ServiceHost::Lane::kQuick,
                                     [](const DeleteEntityRequest& request) {
                                       return DeleteEntityResponse{{1, request.entity}};
                                     });
  }
  static messages::Bytes Encoded(const std::string& entity) {
    messages::Bytes bytes;
    messages::Encode(DeleteEntityRequest{entity}, bytes);
    return bytes;
  }
  static std::string Decoded(const messages::Bytes& bytes) {
    const auto response = messages::Decode<DeleteEntityResponse>(bytes);
    EXPECT_TRUE(response);
    return response ? response->result.error_message : "";
  }

  FakeParticipant participant_;
  ServiceHost host_;
};

TEST_F(ServiceHostTest, NamesTopicsTypesAndHashAsRosDoes) {
  ASSERT_EQ(participant_.topics.size(), 2u);
  EXPECT_EQ(participant_.topics[0].name, "rr/gsv/delete_entityReply");
  EXPECT_EQ(participant_.topics[0].type,
            "simulation_interfaces::srv::dds_::DeleteEntity_Response_");
  EXPECT_EQ(participant_.topics[1].name, "rq/gsv/delete_entityRequest");
  EXPECT_EQ(participant_.topics[1].type, "simulation_interfaces::srv::dds_::DeleteEntity_Request_");
  EXPECT_TRUE(participant_.topics[1].user_data.starts_with("typehash=RIHS01_"));
  EXPECT_TRUE(participant_.topics[1].qos.is_reliable);
}

TEST_F(ServiceHostTest, RepliesToRmwFastrtpsByTheIdentityOfTheRequest) {
  const dds::SampleIdentity identity{{0x01, 0x0f, 9}, 77};
  participant_.on_request(Encoded("pebble"), {kFastClient, identity});
  const Reply reply = participant_.AwaitReply();
  EXPECT_EQ(reply.request.writer, identity.writer);
  EXPECT_EQ(reply.request.sequence, 77);
  EXPECT_EQ(Decoded(reply.sample), "pebble");
}

TEST_F(ServiceHostTest, RepliesToRmwCycloneddsWithTheHeaderOfTheRequest) {
  messages::Bytes header(16);
  for (std::size_t i = 0; i < header.size(); ++i) header[i] = static_cast<std::byte>(i + 1);
  messages::Bytes request = Encoded("pebble");
  request.insert(request.begin() + 4, header.begin(), header.end());
  participant_.on_request(request, {kCycloneClient, {kCycloneClient, 1}});
  Reply reply = participant_.AwaitReply();
  ASSERT_GE(reply.sample.size(), 20u);
  EXPECT_TRUE(std::equal(header.begin(), header.end(), reply.sample.begin() + 4));
  reply.sample.erase(reply.sample.begin() + 4, reply.sample.begin() + 20);
  EXPECT_EQ(Decoded(reply.sample), "pebble");
}

TEST_F(ServiceHostTest, SendsAReplyOnceTheClientIsDiscovered) {
  participant_.knows_clients = false;
  participant_.on_request(Encoded("late"), {kFastClient, {kFastClient, 1}});
  participant_.Discover();
  EXPECT_EQ(Decoded(participant_.AwaitReply().sample), "late");
}

TEST_F(ServiceHostTest, IgnoresRequestsThatCannotBeDecoded) {
  for (const std::size_t size :
       {std::size_t{4}, std::size_t{7}, std::size_t{20}, std::size_t{2 << 20}}) {
    const messages::Bytes bytes(size, std::byte{0xff});
    participant_.on_request(bytes, {kFastClient, {kFastClient, 1}});
    participant_.on_request(bytes, {kCycloneClient, {kCycloneClient, 1}});
  }
  participant_.on_request(Encoded("good"), {kFastClient, {kFastClient, 2}});
  EXPECT_EQ(Decoded(participant_.AwaitReply().sample), "good");
}

TEST_F(ServiceHostTest, AnswersTheQuickLaneWhileTheSlowOneIsBusy) {
  std::promise<void> release, begun;
  ASSERT_TRUE(host_.Submit(ServiceHost::Lane::kSlow, [&] {
    begun.set_value();
    release.get_future().wait();
  }));
  begun.get_future().wait();
  participant_.on_request(Encoded("quick"), {kFastClient, {kFastClient, 1}});
  EXPECT_EQ(Decoded(participant_.AwaitReply().sample), "quick");
  release.set_value();
}

}  // namespace
}  // namespace gsv::ros2
