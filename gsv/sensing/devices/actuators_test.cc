// Lamps, speakers and microphones: what they take, what they show, what is heard.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/actuator.h"
#include "gsv/sensing/devices/lamp.h"
#include "gsv/sensing/devices/microphone.h"
#include "gsv/sensing/devices/speaker.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using namespace std::chrono_literals;
using geometry::PlanarPose;

model::SensorDescription Device(const std::string& type, model::Parameters parameters = {}) {
  model::SensorDescription description;
  description.name = description.type = type;
  description.parameters = std::move(parameters);
  return description;
}

std::unique_ptr<Sensor> MakeDevice(const SensorType& type, model::Parameters parameters = {}) {
  auto made = type.create(Device(type.name, std::move(parameters)));
  EXPECT_TRUE(made) << made.error().Sentence();
  return made ? *std::move(made) : nullptr;
}

world::ActuatorStatePtr Told(const Sensor& actuator, const std::string& robot,
                             world::ActuatorOrder order) {
  EXPECT_TRUE(actuator.actuator()->Check(order));
  return std::make_shared<const world::ActuatorState>(
      world::ActuatorState{robot, actuator.description().name, actuator.actuator()->setup(),
                           std::move(order), base::SimTime(0)});
}

class ActuatorReadings : public ::testing::Test {
 protected:
  ActuatorReadings() {
    const auto body = testing::ModelOf(geometry::Sphere{0.1});
    snapshot_ = testing::MakeSnapshot({{"ear", body, PlanarPose(0, 0, 0, 0), false},
                                       {"far", body, PlanarPose(0, -10, 0, 0), false},
                                       {"near", body, PlanarPose(2, 0, 0, 0), false}});
  }
  void Tell(world::Actuators told) {
    snapshot_->state.actuators = std::make_shared<const world::Actuators>(std::move(told));
  }
  Reading Sampled(const Sensor& sensor, const std::string& robot) {
    return *sensor.Sample(Sampling(snapshot_, snapshot_->layout->Find(robot), 1, rays_));
  }
  static std::vector<double> Values(const Reading& reading) {
    return {reading.values.begin(), reading.values.end()};
  }

  std::shared_ptr<world::Snapshot> snapshot_;
  RaySceneCache rays_;
};

TEST_F(ActuatorReadings, ALampShowsWhatItWasTold) {
  const model::Parameters parameters = {{"colour", std::string("1 0.5 0")},
                                        {"brightness", 0.25},
                                        {"range", 4.0},
                                        {"angle", 1.0},
                                        {"intensity", 3.0},
                                        {"radius", 0.05}};
  const auto lamp = MakeDevice(LampType(), parameters);
  EXPECT_EQ(Values(Sampled(*lamp, "ear")), (std::vector<double>{0.25, 1, 0.5, 0}));
  EXPECT_EQ(lamp->actuator()->first()->values, (std::vector<double>{0.25, 1, 0.5, 0}));
  Tell({Told(*lamp, "ear", {{1, 0, 0, 1}, ""})});
  const Reading reading = Sampled(*lamp, "ear");
  EXPECT_EQ(Values(reading), (std::vector<double>{1, 0, 0, 1}));

  const auto bytes = LampType().encode(Device("lamp", parameters), reading, "ear/lamp");
  const auto message = messages::Decode<messages::gsv_msgs::Lamp>(std::as_bytes(std::span(bytes)));
  ASSERT_TRUE(message);
  EXPECT_EQ(message->brightness, 1);
  EXPECT_EQ(message->color.b, 1);
  EXPECT_EQ(message->range_m, 4);
  EXPECT_EQ(message->angle_rad, 1);
  EXPECT_EQ(message->intensity, 3);
  EXPECT_EQ(message->radius_m, 0.05);
}

TEST_F(ActuatorReadings, ALampIsOffUntilItIsToldUnlessItsFileSaysSo) {
  const auto lamp = MakeDevice(LampType());
  EXPECT_FALSE(lamp->actuator()->first());
  EXPECT_EQ(Values(Sampled(*lamp, "ear")), (std::vector<double>{0, 1, 1, 1}));
}

TEST_F(ActuatorReadings, WhatCannotBeIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, model::ParameterValue>>{{"colour", std::string("1 2 0")},
                                                                  {"colour", std::string("red")},
                                                                  {"colour", 1.0},
                                                                  {"brightness", 2.0},
                                                                  {"range", nan},
                                                                  {"angle", 0.0},
                                                                  {"radius", -1.0}}) {
    const auto lamp = LampType().create(Device("lamp", {{name, value}}));
    ASSERT_FALSE(lamp) << name;
    EXPECT_NE(lamp.error().message.find(name), std::string::npos) << lamp.error().message;
  }
  const auto refused = [](const SensorType& type, world::ActuatorOrder order) {
    return !MakeDevice(type)->actuator()->Check(order);
  };
  EXPECT_TRUE(refused(LampType(), {{}, ""}));
  EXPECT_TRUE(refused(LampType(), {{1.5, 1, 1, 1}, ""}));
  EXPECT_TRUE(refused(LampType(), {{1, 1, nan, 1}, ""}));
  EXPECT_TRUE(refused(SpeakerType(), {{5, 1, 1}, "tone"}));
  EXPECT_TRUE(refused(SpeakerType(), {{440, 1e9, 1}, "tone"}));
  EXPECT_TRUE(refused(SpeakerType(), {{440, 1, 1}, "song"}));
  EXPECT_FALSE(refused(SpeakerType(), {{440, 1, 1}, "chirp"}));
}

TEST_F(ActuatorReadings, ASpeakerSaysWhatItPlaysAndHowLong) {
  const auto speaker = MakeDevice(SpeakerType());
  EXPECT_EQ(Values(Sampled(*speaker, "ear")), (std::vector<double>{0, 0, 0, 0}));
  Tell({Told(*speaker, "ear", {{440, 2, 0.5}, "buzz"})});
  snapshot_->state.time = 500ms;
  const Reading reading = Sampled(*speaker, "ear");
  EXPECT_EQ(Values(reading), (std::vector<double>{440, 0.5, 0.5, 1.5}));
  EXPECT_EQ(reading.labels->front(), "buzz");
  snapshot_->state.time = 2s;
  EXPECT_EQ(Sampled(*speaker, "ear").labels->front(), "");
}

// L = L1 + 20 lg(volume) - 20 lg(r / 1 m), and levels add up as powers.
TEST_F(ActuatorReadings, AMicrophoneHearsByTheInverseSquareLaw) {
  const auto microphone = MakeDevice(MicrophoneType(), {{"ambient", -100.0}});
  const auto speaker = MakeDevice(SpeakerType(), {{"loudness", 85.0}});
  EXPECT_WITHIN(Sampled(*microphone, "ear").values[0], -100, 1e-9, "dB");
  EXPECT_EQ(Sampled(*microphone, "ear").values[1], 0);
  EXPECT_EQ(Sampled(*microphone, "ear").labels->front(), "");

  const auto near = Told(*speaker, "near", {{440, 2, 0.5}, "tone"});
  const auto far = Told(*speaker, "far", {{1000, 2, 1}, "tone"});
  const double near_level = 85 + 20 * std::log10(0.5) - 20 * std::log10(2.0);
  const double far_level = 85 - 20;
  Tell({near});
  EXPECT_WITHIN(Sampled(*microphone, "ear").values[0], near_level, 1e-9, "dB");
  Tell({far});
  EXPECT_WITHIN(Sampled(*microphone, "ear").values[0], far_level, 1e-9, "dB");
  Tell({far, near});
  const Reading both = Sampled(*microphone, "ear");
  EXPECT_WITHIN(both.values[0],
                10 * std::log10(std::pow(10, near_level / 10) + std::pow(10, far_level / 10)), 1e-9,
                "dB");
  EXPECT_EQ(both.values[1], 440);
  EXPECT_EQ(both.labels->front(), "near/speaker");
  // Its own robot's speaker is no nearer than 0.1 m.
  Tell({Told(*speaker, "ear", {{440, 2, 1}, "tone"})});
  EXPECT_WITHIN(Sampled(*microphone, "ear").values[0], 85 + 20, 1e-9, "dB");
}

TEST_F(ActuatorReadings, WhatIsQuieterThanThePlaceIsNotTold) {
  const auto microphone = MakeDevice(MicrophoneType(), {{"ambient", 80.0}});
  const auto speaker = MakeDevice(SpeakerType());
  Tell({Told(*speaker, "far", {{440, 2, 1}, "tone"})});
  const Reading reading = Sampled(*microphone, "ear");
  EXPECT_NEAR(reading.values[0], 10 * std::log10(1e8 + std::pow(10, 6.5)), 1e-9);
  EXPECT_EQ(reading.values[1], 0);
  EXPECT_EQ(reading.labels->front(), "");
}

}  // namespace
}  // namespace gsv::sensing
