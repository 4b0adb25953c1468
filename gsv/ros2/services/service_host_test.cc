#include "gsv/ros2/services/service_host.h"

#include <future>
#include <map>

#include <gtest/gtest.h>

#include "gsv/messages/simulation_interfaces.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::ros2 {
namespace {

using messages::simulation_interfaces::DeleteEntityRequest;
using messages::simulation_interfaces::DeleteEntityResponse;

constexpr dds::Guid kFastClient{0x01, 0x0f, 1}, kCycloneClient{0x01, 0x10, 2};

struct Reply {
  messages::Bytes sample;
  dds::SampleIdentity request;
};

// A participant whose other side is the test. All clients count as discovered.
class FakeParticipant final : public dds::Participant {
 public:
  using OnRequest = std::function<void(std::span<const std::byte>, const dds::Request&)>;

  base::Result<std::unique_ptr<dds::Writer>> MakeWriter(const dds::Topic& topic,
                                                        std::function<void()>) override {
    topics.push_back(topic);
    return std::make_unique<FakeWriter>(*this);
  }
  base::Result<std::unique_ptr<dds::Reader>> MakeReader(
      const dds::Topic&, std::function<void(std::span<const std::byte>)>) override {
    return std::make_unique<FakeReader>();
  }
  base::Result<std::unique_ptr<dds::Reader>> MakeRequestReader(const dds::Topic& topic,
                                                               OnRequest handler) override {
    topics.push_back(topic);
    on_request = std::move(handler);
    return std::make_unique<FakeReader>();
  }
  dds::Guid guid() const override { return {}; }
  std::vector<dds::Endpoint> endpoints() const override { return {}; }

  Reply AwaitReply() {
    base::MutexLock lock(mutex_);
    EXPECT_TRUE(came_.wait_for(lock, simulation::kTimeout,
                               [this]() GSV_REQUIRES(mutex_) { return !replies_.empty(); }));
    if (replies_.empty()) return {};
    Reply reply = std::move(replies_.front());
    replies_.erase(replies_.begin());
    return reply;
  }
  void Discover() { knows_clients = true; }

  std::vector<dds::Topic> topics;
  OnRequest on_request;
  std::atomic<bool> knows_clients{true};

 private:
  class FakeWriter final : public dds::Writer {
   public:
    explicit FakeWriter(FakeParticipant& participant) : participant_(participant) {}
    void WriteParts(std::span<const std::byte>, std::span<const std::byte>) override {}
    void WriteReply(std::span<const std::byte> sample,
                    const dds::SampleIdentity& request) override {
      const base::MutexLock lock(participant_.mutex_);
      participant_.replies_.push_back({{sample.begin(), sample.end()}, request});
      participant_.came_.notify_all();
    }
    bool HasReaderBeside(const dds::Guid&) const override { return participant_.knows_clients; }
    bool has_readers() const override { return true; }
    dds::Guid guid() const override { return {1}; }

   private:
    FakeParticipant& participant_;
  };
  class FakeReader final : public dds::Reader {
   public:
    dds::Guid guid() const override { return {2}; }
    int writers() const override { return 0; }
  };

  base::Mutex mutex_;
  base::ConditionVariable came_;
  std::vector<Reply> replies_ GSV_GUARDED_BY(mutex_);
};

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

TEST_F(ServiceHostTest, IgnoresRequestsThatDoNotDecode) {
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
  ASSERT_TRUE(host_.Do(ServiceHost::Lane::kSlow, [&] {
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
