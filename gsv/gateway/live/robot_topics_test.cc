#include "gsv/gateway/live/step_event_topic.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "gsv/gateway/testing/live_stream_fixture.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/time.h"

namespace gsv::gateway {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Decoded;
using testing::LiveStreamTest;
using testing::ReceivedData;
using testing::RecordingClient;

TEST_F(LiveStreamTest, CommandsAreSentWhenTheyChangeAndToNewSubscribers) {
  simulation_->AddOneRobot();
  Subscribe(1, "/gsv/commands");
  Round();
  EXPECT_TRUE(client_->data(1).empty());  // no message yet
  simulation_->Advance(seconds(1));
  simulation_->SetDriveState("robot_1", {0.5, 0, 0.25}, milliseconds(990));
  Round();
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  const auto command = Decoded<messages::gsv_msgs::Command>(client_->data(1)[0]);
  EXPECT_EQ(command.robot, "robot_1");
  EXPECT_EQ(command.linear_m_s, 0.5);
  EXPECT_EQ(command.angular_rad_s, 0.25);
  EXPECT_EQ(messages::ToSimTime(command.stamp), milliseconds(990));
  EXPECT_EQ(command.step, 99u);
  auto late = std::make_shared<RecordingClient>();
  stream_.hub()->Add(late);
  Subscribe(*late, 1, "/gsv/commands");
  Round();
  EXPECT_EQ(late->data(1).size(), 1u);
}

TEST_F(LiveStreamTest, EachContactIsSentOnceToSubscribers) {
  simulation_->AddOneRobot();
  simulation_->Meet("robot_0", "robot_1");
  Round();
  EXPECT_EQ(simulation_->observers(), 0u);  // without subscribers, nothing observes
  Subscribe(1, "/gsv/contacts");
  Round();
  EXPECT_TRUE(client_->data(1).empty());  // earlier events are not sent
  simulation_->Meet("robot_1", "avatar");
  simulation_->Meet("robot_0", "robot_1");
  Round();
  Round();
  ASSERT_EQ(client_->data(1).size(), 2u);
  EXPECT_EQ(client_->data(1)[0].time_ns, 20'000'000u);
  const auto contact = Decoded<messages::gsv_msgs::Contact>(client_->data(1)[1]);
  EXPECT_EQ(contact.first, "robot_0");
  EXPECT_EQ(contact.second, "robot_1");
  EXPECT_EQ(contact.step, 3u);
  EXPECT_EQ(contact.closing_speed, 0.5);
  EXPECT_NEAR(contact.point.x, std::cos(0.2 * 0.03), 1e-12);
}

TEST_F(LiveStreamTest, CurrentContactsIncludeThoseThatBeganEarlier) {
  simulation_->AddOneRobot();
  simulation_->Meet("robot_0", "robot_1");
  Subscribe(1, "/gsv/current_contacts");
  Round();
  ASSERT_EQ(client_->data(1).size(), 1u);
  const auto message = Decoded<messages::gsv_msgs::Contacts>(client_->data(1)[0]);
  ASSERT_EQ(message.contacts.size(), 2u);
  EXPECT_EQ(message.contacts[1].first, "robot_0");
  EXPECT_EQ(message.contacts[1].second, "robot_1");
  ASSERT_EQ(message.contacts[1].points.size(), 1u);
  EXPECT_EQ(message.left_out, 0u);
  // the contacts come from the newest snapshot, so no observer is needed
  EXPECT_EQ(simulation_->observers(), 0u);
}

TEST_F(LiveStreamTest, ContactsAreNotKeptForFormerSubscribers) {
  Subscribe(1, "/gsv/contacts");
  Round();
  EXPECT_EQ(simulation_->observers(), 1u);
  ASSERT_TRUE(stream_.hub()->Receive(client_.get(), testing::UnsubscribeText(1)));
  Round();
  EXPECT_EQ(simulation_->observers(), 0u);
  Subscribe(2, "/gsv/contacts");
  Round();
  EXPECT_EQ(simulation_->observers(), 1u);
  stream_.hub()->Remove(client_.get());
  Round();
  EXPECT_EQ(simulation_->observers(), 0u);
}

TEST_F(LiveStreamTest, TheNewestOfManyContactsAreSent) {
  Subscribe(1, "/gsv/contacts");
  Round();
  for (int i = 0; i < 100; ++i) simulation_->Meet("robot_0", "avatar");
  Round();
  ASSERT_EQ(client_->data(1).size(), 64u);
  EXPECT_EQ(client_->data(1).back().time_ns, 1'000'000'000u);
}

TEST_F(LiveStreamTest, CommandsOfACrowdAreSpreadOverSeveralRounds) {
  for (int i = 1; i < 100; ++i) simulation_->AddOneRobot();
  simulation_->Advance(seconds(1));
  for (int i = 0; i < 100; ++i) {
    simulation_->SetDriveState("robot_" + std::to_string(i), {1, 0, 0}, milliseconds(10));
  }
  Subscribe(1, "/gsv/commands");
  Round();
  EXPECT_EQ(client_->data(1).size(), 64u);
  Round();
  ASSERT_EQ(client_->data(1).size(), 100u);
  std::set<std::string> robots;
  for (const ReceivedData& data : client_->data(1)) {
    robots.insert(Decoded<messages::gsv_msgs::Command>(data).robot);
  }
  EXPECT_EQ(robots.size(), 100u);
}

}  // namespace
}  // namespace gsv::gateway
