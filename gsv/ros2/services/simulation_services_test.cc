#include "gsv/ros2/services/simulation_services.h"

#include <gtest/gtest.h>

#include "gsv/messages/simulation_interfaces.h"
#include "gsv/ros2/services/testing/fake_participant.h"

namespace gsv::ros2 {
namespace {

using messages::simulation_interfaces::GetCurrentWorldRequest;
using messages::simulation_interfaces::GetCurrentWorldResponse;
using messages::simulation_interfaces::Result;
using testing::FakeParticipant;

constexpr const char* kRequests = "rq/gsv/get_current_worldRequest";

std::uint8_t AskForTheWorld(FakeParticipant& participant) {
  messages::Bytes bytes;
  messages::Encode(GetCurrentWorldRequest{}, bytes);
  participant.on_request(bytes, {testing::kFastClient, {testing::kFastClient, 1}, {{9}, 8}});
  const auto response = messages::Decode<GetCurrentWorldResponse>(participant.AwaitReply().sample);
  EXPECT_TRUE(response);
  return response ? response->result.result : Result::kResultOperationFailed;
}

class SimulationServicesTest : public ::testing::Test {
 protected:
  SimulationServicesTest()
      : simulation_(simulation::Make(simulation::Lockstep(base::SimTime(0)))),
        services_(participant_, true, nullptr) {}

  FakeParticipant participant_;
  std::shared_ptr<simulation::Simulation> simulation_;
  SimulationServices services_;
};

TEST_F(SimulationServicesTest, AnswerRequestsThatArriveAtOnce) {
  int count = 0;
  participant_.on_reader = [&](const dds::Topic& topic) {
    if (topic.name != kRequests) return;
    EXPECT_EQ(AskForTheWorld(participant_), Result::kResultOk);
    ++count;
  };
  services_.Serve(simulation_, {});
  EXPECT_EQ(count, 1);
}

TEST_F(SimulationServicesTest, ServeSeveralSimulationsOneAfterAnother) {
  EXPECT_TRUE(participant_.topics.empty());
  EXPECT_TRUE(services_.readers().empty());
  FakeParticipant::OnRequest ask;
  participant_.on_reader = [&](const dds::Topic& topic) {
    if (topic.name == kRequests) ask = participant_.on_request;
  };
  services_.Serve(nullptr, {});
  const std::size_t topics = participant_.topics.size();
  EXPECT_FALSE(services_.readers().empty());
  participant_.on_request = ask;
  EXPECT_EQ(AskForTheWorld(participant_), Result::kResultIncorrectState);
  services_.Serve(simulation_, {});
  EXPECT_EQ(AskForTheWorld(participant_), Result::kResultOk);
  services_.Serve(nullptr, {});
  EXPECT_EQ(AskForTheWorld(participant_), Result::kResultIncorrectState);
  EXPECT_EQ(participant_.topics.size(), topics);
}

TEST_F(SimulationServicesTest, OfferNothingAfterTheirEnd) {
  services_.Close();
  services_.Serve(simulation_, {});
  EXPECT_TRUE(participant_.topics.empty());
}

}  // namespace
}  // namespace gsv::ros2
